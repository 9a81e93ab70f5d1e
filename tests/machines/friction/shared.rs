//! Contacts at rest that depend on each other, whose friction forces the equations of rigid bodies leave undetermined: all of them hold up to
//! the greatest load that any distribution of forces permits, and those that limit it let go together.
//!
//! The truths are closed forms: of one body with the sum of the friction, or of statics.

use super::{assert_near, events, run, value};
use crate::support::library::machine;
use lagrangian::Solution;
use lagrangian::interpreted::InterpretedMachine;

/// Blocks in a row, joined by rods, on guides or on unilateral contacts. The first is pushed by `F + c t`, uphill where the ground is a slope.
fn blocks(coefficients: &[&str], is_guided: bool) -> InterpretedMachine {
    let all = 1..=coefficients.len();
    let joined = |part: &dyn Fn(usize) -> String| all.clone().map(part).collect::<Vec<_>>();
    let coordinates = joined(&|i| {
        if is_guided {
            format!("x{i}: m = {i}")
        } else {
            format!("x{i}: m = {i}, y{i}: m")
        }
    });
    let bodies = joined(&|i| {
        let height = if is_guided {
            "0".to_string()
        } else {
            format!("y{i}")
        };
        format!("b{i} {{ mass: m{i}, at: (x{i}, {height}) }}")
    });
    let rods: Vec<String> = (2..=coefficients.len())
        .map(|i| format!("rod{i}: x{i} - x{} = 1", i - 1))
        .collect();
    let on_ground = joined(&|i| {
        let friction = coefficients[i - 1];
        if is_guided {
            format!("s{i} {{ body: b{i}, on: ground, direction: (1, 0), {friction} }}")
        } else {
            format!("s{i} {{ gap: y{i}, slip: der(x{i}), restitution: 0, {friction} }}")
        }
    });
    let masses = joined(&|i| format!("m{i}: kg = {i}"));
    let constraints = if rods.is_empty() {
        String::new()
    } else {
        format!("constraints {{ {} }}", rods.join(", "))
    };
    machine(&format!(
        "machine Blocks in plane {{
            parameters {{ F: N = 0, c: N/s = 0, alpha: rad = 0, g: m/s^2 = 10, {} }}
            coordinates {{ {} }}
            bodies {{ {} }}
            gravity (-g*sin(alpha), -g*cos(alpha));
            forces {{ push {{ at: b1.at, force: (F + c*t, 0) }} }}
            {constraints}
            {} {{ {} }}
        }}",
        masses.join(", "),
        coordinates.join(", "),
        bodies.join(", "),
        if is_guided { "sliding" } else { "contacts" },
        on_ground.join(", "),
    ))
}

fn way(run: &Solution<InterpretedMachine>) -> f64 {
    value(&run.end().q, "x1") - 1.0
}

/// Runs blocks under a growing push: they let go at `away`, together, and go as one body with this friction.
#[track_caller]
fn let_go_together(
    machine: &InterpretedMachine,
    set: &[(&str, f64)],
    truth: (f64, f64),
    mass: f64,
) {
    let (away, kinetic) = truth;
    let c = set
        .iter()
        .find(|(name, _)| *name == "c")
        .expect("it grows")
        .1;
    for tolerance in [1e-6, 1e-10] {
        let run = run(machine, set, &[], (tolerance, 2.0 * away)).expect("it runs");
        let known = events(&run);
        assert!(!known.is_empty(), "it lets go");
        for (_, t) in &known {
            // Of unilateral contacts the instant is looked for 1e-9 of a step behind the place where it is seen.
            assert_near(*t, away, 4e-9 * away);
        }
        // m v' = c t − K, with c t₀ at the start: K is what slides, and no more than what stuck.
        let (left, surplus) = (run.end().t - away, c * away - kinetic);
        let expected = (surplus * left * left / 2.0 + c * left * left * left / 6.0) / mass;
        assert_near(way(&run), expected, 1e-7 * (1.0 + expected));
    }
}

/// Two blocks of 1 kg and 2 kg hold μ₁ N₁ + μ₂ N₂ = 5 N + 4 N together, in either way of writing them, and slide with 3 N + 2 N.
#[test]
fn two_blocks_on_a_rod_hold_with_the_friction_of_both() {
    let coefficients = [
        "friction: 0.3, static_friction: 0.5",
        "friction: 0.1, static_friction: 0.2",
    ];
    for is_guided in [true, false] {
        let pair = blocks(&coefficients, is_guided);
        for push in [4.5, 6.0, 8.9, -8.9] {
            let held = run(&pair, &[("F", push)], &[], (1e-9, 2.0)).expect("it runs");
            assert!(held.events().is_empty(), "{push}: {:?}", events(&held));
            assert_near(way(&held), 0.0, 1e-12);
            let forces = held.observe(1.0).expect("in the run").contacts;
            if let [one, two] = forces[..] {
                // What is reported is what the guides allow.
                assert!(
                    one.friction.abs() <= 5.0 && two.friction.abs() <= 4.0,
                    "{forces:?}"
                );
                assert_near(one.friction + two.friction, -push, 1e-12);
            }
        }
        let slid = run(&pair, &[("F", 9.1)], &[], (1e-9, 2.0)).expect("it runs");
        assert_near(way(&slid), (9.1 - 5.0) / 3.0 * 2.0, 1e-8);
        let_go_together(&pair, &[("c", 4.0)], (9.0 / 4.0, 5.0), 3.0);
        let_go_together(&pair, &[("F", -1.0), ("c", 0.5)], (20.0, 5.0 + 1.0), 3.0);
    }
    // One body of 3 kg with the same friction: 5 N of 30 N, 9 N of 30 N.
    let single = blocks(&["friction: 5/30, static_friction: 9/30"], true);
    let_go_together(&single, &[("m1", 3.0), ("c", 4.0)], (9.0 / 4.0, 5.0), 3.0);
}

/// With equal coefficients of both kinds the push only begins to exceed the friction: at 6 N, and then x = (c/m) τ³/6.
#[test]
fn blocks_with_equal_coefficients_begin_to_slide_together() {
    for is_guided in [true, false] {
        let pair = blocks(&["friction: 0.3", "friction: 0.3"], is_guided);
        let set = [("m2", 1.0), ("c", 4.0)];
        let run = run(&pair, &set, &[], (1e-10, 4.0)).expect("it runs");
        for (_, t) in events(&run) {
            assert_near(t, 1.5, 1e-8);
        }
        assert_near(way(&run), 2.5_f64.powi(3) / 3.0, 1e-7);
        let_go_together(&pair, &set, (1.5, 6.0), 2.0);
    }
}

/// Three blocks, of which one may have no friction at all: 5 N + 4 N + 6 N, and kinetic 3 N + 2 N + 3 N.
#[test]
fn three_blocks_hold_together() {
    for is_guided in [true, false] {
        let row = |third: &str| {
            let coefficients = [
                "friction: 0.3, static_friction: 0.5",
                "friction: 0.1, static_friction: 0.2",
                third,
            ];
            blocks(&coefficients, is_guided)
        };
        let rough = row("friction: 0.1, static_friction: 0.2");
        let_go_together(&rough, &[("c", 4.0)], (15.0 / 4.0, 8.0), 6.0);
        let smooth = row("friction: 0, static_friction: 0");
        let_go_together(&smooth, &[("c", 4.0)], (9.0 / 4.0, 5.0), 6.0);
    }
}

/// Blocks on a slope rest where tan α is less than the friction of all by the weight of all, here 9/30, and slide down with 5/30.
#[test]
fn blocks_on_a_rod_rest_on_slopes() {
    let coefficients = [
        "friction: 0.3, static_friction: 0.5",
        "friction: 0.1, static_friction: 0.2",
    ];
    for is_guided in [true, false] {
        let pair = blocks(&coefficients, is_guided);
        for tangent in [0.17_f64, 0.25, 0.299] {
            let set = [("alpha", tangent.atan())];
            let rests = run(&pair, &set, &[], (1e-9, 2.0)).expect("it runs");
            assert_near(way(&rests), 0.0, 1e-12);
        }
        let alpha = 0.31_f64.atan();
        let slides = run(&pair, &[("alpha", alpha)], &[], (1e-9, 2.0)).expect("it runs");
        let expected = -10.0 * (alpha.sin() - alpha.cos() / 6.0) * 2.0;
        assert_near(way(&slides), expected, 1e-8);
    }
}

/// A block that is stopped by friction rests with the other, and lets go again where both can hold no more.
#[test]
fn blocks_stop_and_rest_together() {
    let coefficients = ["friction: 0.3, static_friction: 0.5"; 2];
    for is_guided in [true, false] {
        let pair = blocks(&coefficients, is_guided);
        let set = [("m2", 1.0), ("F", 3.0)];
        let start = [("x1", 1.0, 3.0), ("x2", 2.0, 3.0)];
        let run = run(&pair, &set, &start, (1e-10, 5.0)).expect("it runs");
        // 2 v' = 3 − 6: at rest after 2 s and 3 m.
        assert_near(way(&run), 3.0, 1e-8);
        assert_near(value(&run.end().v, "x1"), 0.0, 1e-12);
    }
}

/// Two collars on a horizontal and a vertical rod, joined by a rod at an angle θ, whose thrust S presses both on their guides. By statics they
/// hold a load P on the upper one while some S has `S cos θ ≤ μ₁ (M g + S sin θ)` and `m g + P − S sin θ ≤ μ₂ S cos θ`.
#[test]
fn collars_that_press_each_other_on_their_guides_hold() {
    let collars = machine(
        "machine Collars in plane {
            parameters { m: kg = 1, M: kg = 1, l: m = 1, P: N = 0, c: N/s = 2, g: m/s^2 = 10, mu1: 1 = 0.4, mu2: 1 = 0.5 }
            coordinates { x: m = 0.6, y: m = 0.8 }
            bodies { low { mass: M, at: (x, 0) }, high { mass: m, at: (0, y) } }
            gravity (0, -g);
            forces { push { at: high.at, force: (0, -P - c*t) } }
            constraints { rod: norm(high.at - low.at) = l }
            sliding {
                floor { body: low, on: ground, direction: (1, 0), friction: mu1 },
                wall { body: high, on: ground, direction: (0, 1), friction: mu2 },
            }
        }",
    );
    let thrust = 0.4 * 10.0 / (0.6 - 0.4 * 0.8);
    let most = thrust * (0.8 + 0.5 * 0.6) - 10.0;
    for tolerance in [1e-6, 1e-10] {
        let run = run(&collars, &[], &[], (tolerance, most / 2.0 + 0.2)).expect("it runs");
        let known = events(&run);
        let names: Vec<&str> = known.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["floor slides", "wall slides"]);
        for (_, t) in &known {
            // Rounding of loads of up to 20 N, and of the root.
            assert_near(*t, most / 2.0, 1e-12);
        }
        assert!(value(&run.end().v, "x") > 0.0);
    }
    // Under μ₁ = tan(π/2 − θ) no load moves the lower one.
    let set = [("mu1", 0.3), ("mu2", 0.3), ("c", 1e3)];
    let start = [("x", 0.28, 0.0), ("y", 0.96, 0.0)];
    let locked = run(&collars, &set, &start, (1e-9, 10.0)).expect("it runs");
    assert!(locked.events().is_empty(), "{:?}", events(&locked));
    assert_near(value(&locked.end().q, "x"), 0.28, 1e-12);
}

/// A box on points of its base, pushed at a height d over its centre down a slope.
fn carton(contact: &str) -> InterpretedMachine {
    machine(&format!(
        "machine Carton in plane {{
            parameters {{
                m: kg = 2, w: m = 0.4, h: m = 0.1, d: m = 0, mu: 1 = 0.3, mu0: 1 = 0.36, g: m/s^2 = 9.81, alpha: rad = 0, c: N/s = 4,
            }}
            coordinates {{ x: m, y: m = h/2, theta: rad }}
            frames {{ slope = ground.turn(alpha), carton = slope.shift(x, y).turn(theta) }}
            bodies {{
                carton {{
                    mass: m, inertia: m*(w^2 + h^2)/12, frame: carton,
                    outline: ((-w/2, -h/2), (w/2, -h/2), (w/2, h/2), (-w/2, h/2)),
                }}
            }}
            gravity (0, -g);
            forces {{ push {{ at: carton.point(0, d), force: -c*t*slope.vector(1, 0) }} }}
            contacts {{ {contact} }}
        }}"
    ))
}

const LAW: &str = "restitution: 0, friction: mu, static_friction: mu0";

/// A box that a growing force pushes lets go at μ₀ m g cos α − m g sin α, wherever it is supported and pushed, and then goes as a point does.
#[test]
fn a_box_lets_go_where_all_its_corners_can_hold_no_more() {
    let point = |name: &str, x: &str| {
        format!("{name} {{ point: ({x}, -h/2), on: carton, along: slope, {LAW} }}")
    };
    let supports = [
        format!("base {{ corners: outline, on: carton, along: slope, {LAW} }}"),
        format!(
            "base {{ corners: outline, on: carton, against: ((-9, -1), (9, -1), (9, 0), (-9, 0)), of: slope, {LAW} }}"
        ),
        [
            point("left", "-w/2"),
            point("middle", "w/8"),
            point("right", "w/2"),
        ]
        .join(", "),
    ];
    for support in &supports {
        let carton = carton(support);
        for (alpha, d) in [(0.0, 0.0), (0.0, 0.03), (0.2, 0.0), (-0.3, -0.02)] {
            let (m, g) = (2.0, 9.81);
            let (weight, pull) = (m * g * f64::cos(alpha), m * g * f64::sin(alpha));
            let away = (0.36 * weight - pull) / 4.0;
            let until = away + 1.2342;
            let set = [("alpha", alpha), ("d", d)];
            let run = run(&carton, &set, &[], (1e-10, until)).expect("it runs");
            let slips: Vec<f64> = events(&run).into_iter().map(|(_, t)| t).collect();
            assert!(!slips.is_empty());
            for t in slips {
                assert_near(t, away, 1e-8);
            }
            let left = until - away;
            let surplus = (0.36 - 0.3) * weight;
            let expected = (surplus * left * left / 2.0 + 4.0 * left * left * left / 6.0) / m;
            assert_near(value(&run.end().q, "x"), -expected, 1e-7);
        }
    }
    // The block as a point.
    let point = machine(
        "machine Point in plane {
            parameters { c: N/s = 4, mu: 1 = 0.3, mu0: 1 = 0.36 }
            coordinates { x: m, y: m }
            bodies { point { mass: 2, at: (x, y) } }
            gravity (0, -9.81);
            forces { push { at: point.at, force: (c*t, 0) } }
            contacts { floor { gap: y, slip: der(x), restitution: 0, friction: mu, static_friction: mu0 } }
        }",
    );
    let run = run(&point, &[], &[], (1e-10, 3.0)).expect("it runs");
    assert_near(value(&run.end().q, "x"), 1.074_96, 5e-6);
}

/// A box on three points, of which the middle one holds more: by statics it may carry up to 4/5 of the weight, the left one the rest and the right
/// one nothing, so that all hold up to (0.36/5 + 0.5·4/5) m g.
#[test]
fn a_box_is_held_as_well_as_any_distribution_of_its_weight_permits() {
    let point = |name: &str, x: &str, holds: &str| {
        format!(
            "{name} {{ point: ({x}, -h/2), on: carton, along: slope, restitution: 0, friction: mu, static_friction: {holds} }}"
        )
    };
    let support = [
        point("left", "-w/2", "mu0"),
        point("middle", "w/8", "0.5"),
        point("right", "w/2", "mu0"),
    ];
    let carton = carton(&support.join(", "));
    let weight = 2.0 * 9.81;
    let away = (0.36 / 5.0 + 0.5 * 4.0 / 5.0) * weight / 4.0;
    for tolerance in [1e-6, 1e-10] {
        // Pushed at the base, so that the push turns nothing.
        let set = [("d", -0.05)];
        let run = run(&carton, &set, &[], (tolerance, away + 1.0)).expect("it runs");
        let known = events(&run);
        assert!(!known.is_empty());
        for (_, t) in &known {
            assert_near(*t, away, 1e-8);
        }
        let surplus = 4.0 * away - 0.3 * weight;
        let expected = (surplus / 2.0 + 4.0 / 6.0) / 2.0;
        assert_near(value(&run.end().q, "x"), -expected, 1e-7);
    }
}
