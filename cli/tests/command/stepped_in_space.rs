//! Boxes in space that slide, turn and tumble in time stepping, against closed forms and against runs that find every event.

use serde_json::Value;

use crate::collisions::{close, number, simulate};
use crate::support::Scratch;
use crate::time_stepping::step;

const G: f64 = 9.81;

/// A box of half edges a, b and c on four feet, in axes along a slope of the angle α and normal to it.
const BOX: &str = "machine Box in space {
    parameters {
        m: kg = 0.8, a: m = 0.1, b: m = 0.06, c: m = 0.04, alpha: rad = 0, beta: rad = 0.7, mu: 1 = 0.3, speed: m/s = 0, turning: rad/s = 0, g: m/s^2 = 9.81,
    }
    coordinates {
        x: m, y: m, z: m = c, yaw: rad, pitch: rad, roll: rad,
        der(x): m/s = speed*cos(beta), der(y): m/s = speed*sin(beta), der(yaw): rad/s = turning,
    }
    frames { held = ground.shift(x, y, z).turn(z, yaw).turn(y, pitch).turn(x, roll) }
    bodies { box { mass: m, inertia: (m/3*(b^2 + c^2), m/3*(a^2 + c^2), m/3*(a^2 + b^2)), frame: held } }
    // The slope falls in the direction β.
    gravity (g*sin(alpha)*cos(beta), g*sin(alpha)*sin(beta), -g*cos(alpha));
    contacts { floor { corners: ((a, b, -c), (a, -b, -c), (-a, b, -c), (-a, -b, -c)), on: held, along: ground, restitution: 0.3, friction: mu } }
}";

/// However the feet share the load, the friction of a box that slides in a straight line is μ times the weight on the floor, and it is braked by `μ g cos α` along
/// its path, which gravity changes by `g sin α`. Up to `tan α = μ` a box at rest stays. Forces are constant, so that rates have no error but rounding.
#[test]
fn a_box_slides_and_sticks_on_four_feet() {
    let spec = Scratch::new("box.machine", BOX);
    let (h, mu) = (1.0 / 512.0, 0.3_f64);
    let along = |run: &Value| {
        let [x, y] = ["x", "y"].map(|name| number(&run["v"][name]));
        let (across, along) = 0.7_f64.sin_cos();
        close(y * along - x * across, 0.0, 1e-11);
        for name in ["z", "yaw", "pitch", "roll"] {
            close(number(&run["v"][name]), 0.0, 1e-10);
        }
        x * along + y * across
    };
    let slides = step(spec.path(), 0.25, h, &["--set", "speed=1.5"]);
    close(along(&slides), 1.5 - mu * G * 0.25, 1e-11);
    let stops = step(spec.path(), 1.0, h, &["--set", "speed=1.5"]);
    close(along(&stops), 0.0, 1e-12);
    let way = 1.5 * 1.5 / (2.0 * mu * G);
    let [x, y] = ["x", "y"].map(|name| number(&stops["q"][name]));
    // The step in which it stops moves it by v h/2 in place of v²/(2 a), with v ≤ a h.
    close(x.hypot(y), way, 0.5 * mu * G * h * h);
    for (share, holds) in [(0.99, true), (1.01, false)] {
        let alpha = (share * mu).atan();
        let setting = format!("alpha={alpha:?}");
        let run = step(spec.path(), 1.0, h, &["--set", &setting]);
        let expected = if holds {
            0.0
        } else {
            G * (alpha.sin() - mu * alpha.cos())
        };
        close(along(&run), expected, 1e-11);
        close(number(&run["energy_residual"]), 0.0, 1e-12);
    }
}

/// A box that turns about its vertical axis without moving presses alike with its four feet, at the distance r from the axis: the friction is `μ m g` in all, and slows
/// the rotation down by `μ m g r/I`, with `I = m (a² + b²)/3 = m r²/3`.
#[test]
fn a_box_spins_down_on_four_feet() {
    let spec = Scratch::new("box.machine", BOX);
    let (mu, r) = (0.3, 0.1_f64.hypot(0.06));
    let h = 1.0 / 1024.0;
    for (turning, until) in [(20.0, 0.1), (-35.0, 0.2), (5.0, 0.5)] {
        let setting = format!("turning={turning:?}");
        let run = step(spec.path(), until, h, &["--set", &setting]);
        let left = f64::max(0.0, f64::abs(turning) - 3.0 * mu * G / r * until);
        close(number(&run["v"]["yaw"]), left.copysign(turning), 1e-10);
        for name in ["x", "y", "z", "pitch", "roll"] {
            close(number(&run["v"][name]), 0.0, 1e-10);
        }
        let inertia = 0.8 * r * r / 3.0;
        let lost = 0.5 * inertia * (turning * turning - left * left);
        close(number(&run["dissipated"]), lost, 1e-10);
    }
}

/// A box that slides and turns slows down as by events, where its feet share the load by the same rule; the difference decreases with the step.
#[test]
fn a_box_that_slides_and_turns_moves_as_by_events() {
    let spec = Scratch::new("box.machine", BOX);
    let settings = ["--set", "speed=1.5", "--set", "turning=8"];
    let exact = simulate(spec.path(), 0.3, &["speed=1.5", "turning=8"]);
    let error = |h: f64| {
        let run = step(spec.path(), 0.3, h, &settings);
        assert_eq!(run["warnings"].as_array().map(Vec::len), Some(0), "{run:#}");
        let missed = |name: &str| (number(&run["v"][name]) - number(&exact["v"][name])).abs();
        missed("x").max(missed("y")).max(0.1 * missed("yaw"))
    };
    let errors = [4e-3, 1e-3].map(error);
    assert!(
        errors[1] < 0.5 * errors[0] && errors[1] < 2e-3,
        "{errors:?}"
    );
}

/// Three boxes in space that are thrown, tumble, slide and come to rest on their faces: impulses of every step obey the law, without a warning, and the balance
/// of energy closes up to the error of the steps, whose rotations are of second order.
#[test]
fn boxes_in_space_come_to_rest() {
    let spec = Scratch::new(
        "boxes.machine",
        "machine Boxes in space {
            constants { N = 3 }
            parameters { m: kg = 0.8, a: m = 0.1, b: m = 0.06, c: m = 0.04, e: 1 = 0.2, mu: 1 = 0.4, vx: m/s = 0.6, g: m/s^2 = 9.81 }
            coordinates {
                x[i in 1..N]: m = 0.4*i, y[i in 1..N]: m, z[i in 1..N]: m = 0.2 + 0.05*i,
                yaw[i in 1..N]: rad, pitch[i in 1..N]: rad = 0.3*i/N, roll[i in 1..N]: rad = 0.4 - 0.1*i,
                der(x[1]): m/s = vx, der(x[2]): m/s = -0.5, der(y[3]): m/s = 0.8, der(yaw[1]): rad/s = 2, der(yaw[3]): rad/s = -3,
            }
            frames { held[i in 1..N] = ground.shift(x[i], y[i], z[i]).turn(z, yaw[i]).turn(y, pitch[i]).turn(x, roll[i]) }
            bodies { box[i in 1..N] { mass: m, inertia: (m/3*(b^2 + c^2), m/3*(a^2 + c^2), m/3*(a^2 + b^2)), frame: held[i] } }
            gravity (0, 0, -g);
            contacts {
                floor[i in 1..N] {
                    corners: ((a, b, c), (a, b, -c), (a, -b, c), (a, -b, -c), (-a, b, c), (-a, b, -c), (-a, -b, c), (-a, -b, -c)),
                    on: held[i], along: ground, restitution: e, friction: mu,
                },
            }
        }",
    );
    // By events they rest on their largest faces, too: both have lost the same energy.
    for (vx, h) in [
        ("vx=0.6", 2e-3),
        ("vx=0.6", 1e-3),
        ("vx=0.5", 2e-3),
        ("vx=0.5", 1e-3),
    ] {
        let exact = simulate(spec.path(), 1.0, &[vx]);
        let lost = number(&exact["dissipated"]);
        let run = step(spec.path(), 1.0, h, &["--set", vx]);
        assert_eq!(run["warnings"].as_array().map(Vec::len), Some(0), "{run:#}");
        for rate in run["v"].as_object().expect("rates").values() {
            close(number(rate), 0.0, 1e-9);
        }
        for i in 1..=3 {
            close(number(&run["q"][format!("z[{i}]")]), 0.04, 1e-9);
        }
        let residual = number(&run["energy_residual"]);
        close(number(&run["dissipated"]) - residual, lost, 1e-9);
        // They turn by no more than 30 rad/s, and so by 30 h in a step.
        close(residual, 0.0, (30.0 * h).powi(2) * lost);
    }
}

/// Three boxes that fall one onto the other rattle until they lie, by events in thousands of impacts. A run changes over to time stepping where these crowd, and all
/// boxes come to rest on their faces.
#[test]
fn boxes_that_fall_onto_each_other_hand_over() {
    let spec = Scratch::new(
        "stack.machine",
        "machine Stack in space {
            constants { N = 3 }
            parameters { m: kg = 0.8, a: m = 0.1, b: m = 0.06, c: m = 0.04, e: 1 = 0.2, mu: 1 = 0.4, g: m/s^2 = 9.81 }
            coordinates {
                x[i in 1..N]: m = 0.01*(i-1), y[i in 1..N]: m = 0.005*(i-1), z[i in 1..N]: m = 0.15 + 0.25*(i-1),
                yaw[i in 1..N]: rad = 0.3*i, pitch[i in 1..N]: rad = 0.1, roll[i in 1..N]: rad = 0.15*i/N,
                der(x[1]): m/s = 0.3, der(yaw[1]): rad/s = 2,
            }
            frames {
                held[i in 1..N] = ground.shift(x[i], y[i], z[i]).turn(z, yaw[i]).turn(y, pitch[i]).turn(x, roll[i]),
                top[i in 1..N] = held[i].shift(0, 0, c),
            }
            bodies { box[i in 1..N] { mass: m, inertia: (m/3*(b^2 + c^2), m/3*(a^2 + c^2), m/3*(a^2 + b^2)), frame: held[i] } }
            gravity (0, 0, -g);
            contacts {
                floor { corners: ((a, b, -c), (a, -b, -c), (-a, b, -c), (-a, -b, -c)), on: held[1], along: ground, restitution: e, friction: mu },
                second { corners: ((a, b, -c), (a, -b, -c), (-a, b, -c), (-a, -b, -c)), on: held[2], along: top[1], restitution: e, friction: mu },
                third { corners: ((a, b, -c), (a, -b, -c), (-a, b, -c), (-a, -b, -c)), on: held[3], along: top[2], restitution: e, friction: mu },
            }
        }",
    );
    let run = simulate(spec.path(), 1.0, &[]);
    assert_eq!(run["error"], Value::Null, "{run:#}");
    let handovers = run["handovers"].as_array().expect("it changes over");
    assert_eq!(handovers[0]["to"], "moreau", "{handovers:#?}");
    for (i, height) in [(1, 0.04), (2, 0.12), (3, 0.2)] {
        close(number(&run["q"][format!("z[{i}]")]), height, 1e-9);
    }
    for rate in run["v"].as_object().expect("rates").values() {
        close(number(rate), 0.0, 1e-9);
    }
    // The longest steps are below 2 ms, in which nothing turns by more than 30 rad/s.
    close(
        number(&run["energy_residual"]),
        0.0,
        0.06_f64.powi(2) * number(&run["dissipated"]),
    );
}

/// Numbers between −1 and 1 that look drawn at random.
fn drawn(seed: &mut u64) -> f64 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// The product of two quaternions.
fn turned([w, x, y, z]: [f64; 4], [a, b, c, d]: [f64; 4]) -> [f64; 4] {
    [
        w * a - x * b - y * c - z * d,
        w * b + x * a + y * d - z * c,
        w * c - x * d + y * a + z * b,
        w * d + x * c - y * b + z * a,
    ]
}

/// One to four boxes of random masses that are thrown on a plane, which may be a slope, or plates that fall one onto the other, each with a speed and a spin of its
/// own. Restitution is the same along normals and tangents, so that no impact creates energy.
fn thrown(seed: &mut u64) -> String {
    let mut draw = || drawn(seed);
    let among = |values: &[f64], drawn: f64| {
        let place = (0.5 + 0.5 * drawn) * values.len() as f64;
        values[(place as usize).min(values.len() - 1)]
    };
    let is_stack = draw() > -0.3;
    let count = among(&[1.0, 2.0, 3.0, 4.0], draw()) as usize;
    let friction = among(&[0.1, 0.3, 0.4, 0.6, 0.8, 1.0], draw());
    let restitution = among(&[0.0, 0.2, 0.5, 0.8], draw());
    let more_at_rest = among(&[1.0, 1.0, 1.3], draw());
    let [a, b, c] = [0.1, 0.06, 0.04].map(|size| size * (1.0 + 0.6 * draw()));
    let tilt = among(&[0.0, 0.02, 0.15], draw());
    let gap = among(&[0.0, 0.03, 0.1], draw());
    let slope = among(&[0.0, 0.0, 0.2, 0.35], draw());
    let falls = 3.0 * draw();
    let [
        mut masses,
        mut coordinates,
        mut frames,
        mut bodies,
        mut contacts,
    ] = [const { String::new() }; 5];
    for k in 1..=count {
        let above = (k - 1) as f64;
        let [x, y, z] = if is_stack {
            let apart = 2.0 * c + 0.001 + 3.5 * tilt * (a + b) + gap;
            let lowest = 0.001 + c + 2.2 * tilt * (a + b);
            [0.02 * draw(), 0.02 * draw(), lowest + apart * above]
        } else {
            [0.4 * above, 0.0, 0.25 + 0.05 * above]
        };
        let angles = if is_stack {
            [3.0, tilt, tilt]
        } else {
            [1.5, 0.5, 0.5]
        };
        let mut e = [1.0, 0.0, 0.0, 0.0];
        for (axis, most) in [3, 2, 1].into_iter().zip(angles) {
            let (sin, cos) = (0.5 * most * draw()).sin_cos();
            let mut by = [cos, 0.0, 0.0, 0.0];
            by[axis] = sin;
            e = turned(e, by);
        }
        let spin = [0.0, 1.5 * draw(), 1.5 * draw(), 1.5 * draw()];
        let de = turned(e, spin);
        let [vx, vy, vz] = [0; 3].map(|_| 0.8 * draw());
        let mass = (1.5 * draw()).exp();
        coordinates += &format!(
            "x{k}: m = {x:?}, y{k}: m = {y:?}, z{k}: m = {z:?}, der(x{k}): m/s = {vx:?}, der(y{k}): m/s = {vy:?}, der(z{k}): m/s = {vz:?},\n"
        );
        for (name, (e, de)) in ["o", "i", "j", "k"].into_iter().zip(e.into_iter().zip(de)) {
            coordinates += &format!("{name}{k}: 1 = {e:?}, der({name}{k}): 1/s = {de:?},\n");
        }
        frames += &format!(
            "held{k} = ground.shift(x{k}, y{k}, z{k}).turn(o{k}, i{k}, j{k}, k{k}), top{k} = held{k}.shift(0, 0, c),\n"
        );
        bodies += &format!(
            "box{k} {{ mass: m{k}, inertia: (m{k}/3*(b^2 + c^2), m{k}/3*(a^2 + c^2), m{k}/3*(a^2 + b^2)), frame: held{k} }},\n"
        );
        masses += &format!(", m{k}: kg = {mass:?}");
        let on = match (is_stack, k) {
            (false, _) | (_, 1) => String::from("ground"),
            _ => format!("top{}", k - 1),
        };
        let upper = if is_stack {
            ""
        } else {
            ", (a, b, c), (a, -b, c), (-a, b, c), (-a, -b, c)"
        };
        contacts += &format!(
            "c{k} {{ corners: ((a, b, -c), (a, -b, -c), (-a, b, -c), (-a, -b, -c){upper}), on: held{k}, along: {on}, \
             restitution: e, tangential_restitution: e, friction: mu, static_friction: {more_at_rest:?}*mu }},\n"
        );
    }
    let [gx, gy, gz] = [
        9.81 * slope.sin() * falls.cos(),
        9.81 * slope.sin() * falls.sin(),
        -9.81 * slope.cos(),
    ];
    format!(
        "machine Thrown in space {{
            parameters {{ a: m = {a:?}, b: m = {b:?}, c: m = {c:?}, e: 1 = {restitution:?}, mu: 1 = {friction:?}{masses} }}
            coordinates {{ {coordinates} }}
            frames {{ {frames} }}
            bodies {{ {bodies} }}
            gravity ({gx:?}, {gy:?}, {gz:?});
            contacts {{ {contacts} }}
        }}"
    )
}

/// Impulses of random boxes and stacks are found in every step: no run ends with an error, or tells that contacts met without restitution or shared their load in
/// another way than they should. `STACKS` is their number and `SEED` the first of them.
#[test]
fn impulses_of_random_stacks_are_found_in_every_step() {
    let of_environment = |name: &str| std::env::var(name).ok().and_then(|text| text.parse().ok());
    let mut seed: u64 = of_environment("SEED").unwrap_or(0x9e37_79b9_7f4a_7c15);
    for stack in 0..of_environment("STACKS").unwrap_or(8) {
        println!("stack {stack}: SEED={seed}");
        let spec = Scratch::new("thrown.machine", &thrown(&mut seed));
        let run = step(spec.path(), 1.0, 1e-3, &[]);
        let warnings = run["warnings"].as_array().expect("warnings");
        let told = warnings.iter().filter(|told| {
            let told = told.as_str().expect("a text");
            told.contains("share their load") || told.contains("admitted no motion")
        });
        assert_eq!(told.count(), 0, "stack {stack}: {warnings:#?}");
        // That only closed contacts gave impulses in some steps is told, and is no failure.
        for told in warnings.iter().filter_map(Value::as_str) {
            if told.contains("no impulses of all contacts were found") {
                println!("stack {stack}: {told}");
            }
        }
    }
}
