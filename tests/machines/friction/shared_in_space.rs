//! Contacts and guides in space that share a load: all of them hold up to the greatest load that any distribution of forces permits.
//!
//! The truths are closed forms of statics, and of one body that slides.

use super::{assert_near, events, run, value};
use crate::support::library::machine;
use lagrangian::interpreted::InterpretedMachine;

const G: f64 = 9.81;

/// A body of 2 kg that a growing force pushes along the ground of a frame `bed`.
fn pushed(bed: &str, supports: &str, law: &str) -> InterpretedMachine {
    machine(&format!(
        "machine Pushed in space {{
            parameters {{ m: kg = 2, mu: 1 = 0.3, mu0: 1 = 0.36, c: N/s = 4, dir: rad = 0, d: m = 0, g: m/s^2 = 9.81 }}
            coordinates {{ x: m, y: m, z: m, yaw: rad, theta: rad, phi: rad }}
            frames {{
                {bed},
                held = bed.shift(x, y, z).turn(z, yaw).turn(y, theta).turn(x, phi),
            }}
            bodies {{ body {{ mass: m, inertia: (0.02, 0.03, 0.04), frame: held }} }}
            gravity (0, 0, -g);
            forces {{ push {{ at: held.point(0, 0, d), force: c*t*bed.vector(cos(dir), sin(dir), 0) }} }}
            contacts {{ {supports} }}
        }}"
    ).replace("LAW", law))
}

const LAW: &str = "restitution: 0, friction: mu, static_friction: mu0";

/// The body lets go at `away` and slides with the remaining friction in the direction of its push.
#[track_caller]
fn lets_go(
    body: &InterpretedMachine,
    set: &[(&str, f64)],
    (away, kinetic): (f64, f64),
    direction: f64,
    name: &str,
) {
    for tolerance in [1e-6, 1e-10] {
        let until = away + 0.7321;
        let run = run(body, set, &[], (tolerance, until))
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let known = events(&run);
        assert!(!known.is_empty(), "{name}: it lets go");
        for (what, t) in &known {
            // The instant is looked for 1e-9 of a step behind the place where it is seen.
            assert!((t - away).abs() < 1e-8, "{name}: {what} at {t}, not {away}");
        }
        let (left, surplus) = (until - away, 4.0 * away - kinetic);
        let way = (surplus * left * left / 2.0 + 4.0 * left * left * left / 6.0) / 2.0;
        let (sin, cos) = direction.sin_cos();
        let end = [value(&run.end().q, "x"), value(&run.end().q, "y")];
        assert_near(end[0], way * cos, 2e-7);
        assert_near(end[1], way * sin, 2e-7);
    }
}

/// A box on four corners, a table on five legs and a tripod hold μ₀ m g in every direction, wherever they are pushed.
#[test]
fn tables_let_go_as_points_do() {
    let supports = [
        "floor { corners: ((0.2, 0.15, 0), (0.2, -0.15, 0), (-0.2, 0.15, 0), (-0.2, -0.15, 0)), on: held, along: bed, LAW }",
        "floor { corners: ((0.3, 0, 0), (0.1, 0.3, 0), (-0.2, 0.2, 0), (-0.2, -0.2, 0), (0.1, -0.3, 0)), on: held, along: bed, LAW }",
        "floor { corners: ((0.2, 0, 0), (-0.1, 0.17320508075688773, 0), (-0.1, -0.17320508075688773, 0)), on: held, along: bed, LAW }",
    ];
    for support in supports {
        let body = pushed("bed = ground.shift(0, 0, 0)", support, LAW);
        for (direction, height) in [(0.0, 0.0), (0.7, 0.02), (-2.0, -0.03)] {
            let set = [("dir", direction), ("d", height)];
            let weight = 2.0 * G;
            let truth = (0.36 * weight / 4.0, 0.3 * weight);
            lets_go(&body, &set, truth, direction, support);
        }
    }
}

/// A body in a V groove whose sides have the angle β: by statics it is wedged in up to `μ₀ m g/(cos β √(1 − μ₀² tan² β))`, and it slides with
/// `μ m g/cos β`.
#[test]
fn a_body_in_a_groove_is_held_by_wedging() {
    let side = |name: &str, y: f64, frame: &str| {
        format!(
            "{name} {{ corners: ((0.2, {y}, 0), (-0.2, {y}, 0)), on: held, along: {frame}, LAW }}"
        )
    };
    for beta in [0.3_f64, 0.7] {
        // The points are where their sides are.
        let sides = [side("one", 0.1, "high"), side("other", -0.1, "low")].join(", ");
        let bed = format!(
            "bed = ground.shift(0, 0, 0), high = bed.shift(0, 0.1, 0).turn(x, {beta}), low = bed.shift(0, -0.1, 0).turn(x, -{beta})"
        );
        let body = pushed(&bed, &sides, LAW);
        let (weight, wedged) = (2.0 * G, 0.36 * beta.tan());
        let most = 0.36 * weight / (beta.cos() * (1.0 - wedged * wedged).sqrt());
        let truth = (most / 4.0, 0.3 * weight / beta.cos());
        lets_go(&body, &[], truth, 0.0, "groove");
    }
}

/// Two blocks of 1 kg and 2 kg, joined by a rod, on surfaces that hold them from both sides: together they hold μ₁ N₁ + μ₂ N₂ = 5 N + 4 N
/// along the rod, and slide with 3 N + 2 N.
#[test]
fn guides_on_surfaces_hold_together() {
    for is_on_surface in [true, false] {
        let second = if is_on_surface {
            "table2 { body: b2, on: ground, normal: (0, 0, 1), friction: 0.1, static_friction: 0.2 }"
        } else {
            "rail { body: b2, on: ground, direction: (1, 0, 0), friction: 0.1, static_friction: 0.2 }"
        };
        let coordinates = if is_on_surface {
            "x2: m = 1, y2: m"
        } else {
            "x2: m = 1"
        };
        let at = if is_on_surface {
            "(x2, y2, 0)"
        } else {
            "(x2, 0, 0)"
        };
        let blocks = machine(&format!(
            "machine Blocks in space {{
                parameters {{ F: N = 0, c: N/s = 4 }}
                coordinates {{ x1: m, y1: m, {coordinates} }}
                bodies {{ b1 {{ mass: 1, at: (x1, y1, 0) }}, b2 {{ mass: 2, at: {at} }} }}
                gravity (0, 0, -10);
                forces {{ push {{ at: b1.at, force: (F + c*t, 0, 0) }} }}
                constraints {{ rod: x2 - x1 = 1 }}
                sliding {{ table {{ body: b1, on: ground, normal: (0, 0, 1), friction: 0.3, static_friction: 0.5 }}, {second} }}
            }}"
        ));
        let away = 9.0 / 4.0;
        let held = run(&blocks, &[("F", 8.9), ("c", 0.0)], &[], (1e-9, 2.0)).expect("it runs");
        assert!(held.events().is_empty(), "{:?}", events(&held));
        let run = run(&blocks, &[], &[], (1e-10, away + 1.0)).expect("it runs");
        let known = events(&run);
        assert!(!known.is_empty(), "they let go");
        for (what, t) in &known {
            assert!((t - away).abs() < 1e-8, "{what} at {t}");
        }
        // 3 kg with 9 N + c τ against 5 N.
        let expected = (4.0 / 2.0 + 4.0 / 6.0) / 3.0;
        assert_near(value(&run.end().q, "x1"), expected, 1e-7);
    }
}
