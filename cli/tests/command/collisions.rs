//! Machines whose parts collide, against closed forms and published numbers.

use std::f64::consts::PI;

use crate::support::{Scratch, lagrangian};
use serde_json::Value;

pub fn simulate(spec: &str, until: f64, settings: &[&str]) -> Value {
    let until = format!("{until:?}");
    let mut arguments = vec!["simulate", spec, "--until", &until, "--json"];
    arguments.extend(["--tolerance", "1e-13"]);
    for setting in settings {
        arguments.extend(["--set", setting]);
    }
    let output = lagrangian(&arguments);
    let text = String::from_utf8(output.stdout).expect("text");
    let said = String::from_utf8_lossy(&output.stderr);
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}{said}"))
}

pub fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("no number: {value}"))
}

pub fn events<'a>(run: &'a Value, kind: &str) -> Vec<&'a Value> {
    let all = run["contact_events"].as_array().expect("events").iter();
    all.filter(|event| event["kind"] == kind).collect()
}

#[track_caller]
pub fn close(found: f64, expected: f64, within: f64) {
    let error = (found - expected).abs();
    assert!(error <= within, "{found} is {error:e} off {expected}");
}

/// Asserts that a run has no error, and an energy balance that closes up to round-off of the energy exchanged.
#[track_caller]
pub fn is_good(run: &Value) {
    assert_eq!(run["error"], Value::Null, "{run:#}");
    assert_eq!(
        run["warnings"].as_array().map(Vec::len),
        Some(0),
        "{}",
        run["warnings"]
    );
}

/// The bounces accumulate at √(2h/g) (1 + e)/(1 − e), with h = 1 m and e = 0.8; the fifth impact is at √(2h/g) (1 + 2(e + … + e⁴)), and the speed
/// after it is e⁵ √(2gh).
#[test]
fn a_ball_comes_to_rest_where_its_bounces_accumulate() {
    let run = simulate("machines/contacts/bouncing_ball.machine", 5.0, &[]);
    is_good(&run);
    let impacts = events(&run, "impact");
    let times = |k: usize| number(&impacts[k]["t"]);
    // Each earlier impact adds a rounding of the time.
    close(times(0), 0.451_523_640_985_730_9, 1e-15);
    close(times(4), 2.584_160_102_089_535, 1e-14);
    close(
        number(&impacts[4]["gap_rate"][1]),
        1.451_441_166_113_184_2,
        1e-13,
    );
    let closes = events(&run, "closes");
    assert_eq!(closes.len(), 1);
    close(number(&closes[0]["t"]), 4.063_712_768_871_578, 1e-12);
    assert!(number(&closes[0]["time_error"]) < 1e-8);
    assert_eq!((number(&run["q"]["y"]), number(&run["v"]["y"])), (0.0, 0.0));
    // The entire potential energy at the height of 1 m.
    close(number(&run["impact_loss"]), 0.1 * 9.81, 1e-12);
    close(number(&run["energy_residual"]), 0.0, 1e-12);
}

/// A block that falls to the ground and stays there glides on against a damper, by v m/c (1 − exp(−c t/m)). Whether its height is a little above 0 or below
/// when it lands is for rounding to say; so it falls from many heights.
#[test]
fn what_lands_without_a_bounce_stays_down() {
    let spec = Scratch::new(
        "landing.machine",
        "machine Landing in plane {
            parameters { m: kg = 0.3, c: N*s/m = 0.05, g: m/s^2 = 9.81, h: m = 0.2, v: m/s = 2.3 }
            coordinates { x: m, y: m = h, der(x): m/s = v }
            bodies { block { mass: m, at: (x, y) } }
            gravity (0, -g);
            dampers { air { damping: c, stretch: x } }
            contacts { ground { gap: y, restitution: 0 } }
        }",
    );
    for i in 0..40 {
        let h = 0.2 + 0.001_37 * f64::from(i);
        let run = simulate(spec.path(), 0.9, &[&format!("h={h:?}")]);
        is_good(&run);
        let impacts = events(&run, "impact");
        assert_eq!((impacts.len(), events(&run, "closes").len()), (1, 1), "{h}");
        close(number(&impacts[0]["t"]), (2.0 * h / 9.81).sqrt(), 1e-14);
        let gone = 2.3 * 0.3 / 0.05 * (1.0 - (-0.05 * 0.9 / 0.3_f64).exp());
        close(number(&run["q"]["x"]), gone, 1e-11);
        close(number(&run["q"]["y"]), 0.0, 1e-15);
    }
}

/// A ball whose height is measured from far below has the same accumulation time, as far as the rounding of its position allows: bounces as low as
/// round-off are ended before they become noise.
#[test]
fn bounces_as_low_as_rounding_are_closed() {
    let spec = Scratch::new(
        "high.machine",
        "machine High in plane {
            parameters { e: 1 = 0.8, g: m/s^2 = 9.81, h: m = 1000 }
            coordinates { y: m = h + 1 }
            bodies { ball { mass: 1, at: (0, y) } }
            gravity (0, -g);
            contacts { floor { gap: y - h, restitution: e } }
        }",
    );
    let run = simulate(spec.path(), 5.0, &[]);
    is_good(&run);
    let closes = events(&run, "closes");
    // A height of 1e-13 m corresponds to a fall of 1.4e-7 s, which is the possible error of each of the last bounces.
    close(number(&closes[0]["t"]), 4.063_712_768_871_578, 3e-6);
}

/// With all closed contacts in one impact: (−1/3, 2/3, 2/3) for e = 1, (0, 1/2, 1/2) for e = ½, (1/3, 1/3, 1/3) for e = 0.
#[test]
fn a_cradle_moves_as_moreaus_law_says() {
    let third = 1.0 / 3.0;
    for (e, expected) in [
        ("1", [-third, 2.0 * third, 2.0 * third]),
        ("0.5", [0.0, 0.5, 0.5]),
        ("0", [third; 3]),
    ] {
        let run = simulate(
            "machines/contacts/newtons_cradle.machine",
            1.5,
            &[&format!("e={e}")],
        );
        assert_eq!(run["error"], Value::Null, "{run:#}");
        for (ball, expected) in ["a", "b", "c"].iter().zip(expected) {
            close(number(&run["v"][ball]), expected, 1e-14);
        }
    }
}

/// On a spring with a stop at its equilibrium every flight takes half a period, and each impact multiplies the speed by e.
#[test]
fn an_oscillator_bounces_every_half_period() {
    let run = simulate("machines/contacts/impact_oscillator.machine", 10.0, &[]);
    is_good(&run);
    let impacts = events(&run, "impact");
    assert_eq!(impacts.len(), 6);
    for (k, impact) in impacts.iter().enumerate() {
        close(number(&impact["t"]), PI / 4.0 + k as f64 * PI / 2.0, 1e-12);
        let speed = 2.0 * 0.8_f64.powi(k as i32);
        close(number(&impact["gap_rate"][0]), -speed, 1e-11);
        close(
            number(&impact["loss"]),
            0.5 * speed * speed * (1.0 - 0.64),
            1e-11,
        );
    }
}

/// Housner's block: its quarter period is the elliptic integral of an inverted rigid pendulum, and each impact multiplies the angular velocity by 1 −
/// 3/2 sin²α; twelve impacts in a row.
#[test]
fn a_block_rocks_as_housner_says() {
    let run = simulate("machines/contacts/rocking_block.machine", 1.0, &[]);
    is_good(&run);
    let impacts = events(&run, "impact");
    close(number(&impacts[0]["t"]), 0.493_803_215_078_831_9, 1e-12);
    let after = number(&impacts[0]["v"]["theta"]).abs();
    // ω before the impact by energy: the block falls from θ₀ to 0 about its corner, R² = b² + h².
    let (b, h, g) = (0.25_f64, 1.0_f64, 9.81_f64);
    let tilt = 0.122_489_331_563_432_08_f64;
    let fall = b * tilt.sin() + h * tilt.cos() - h;
    let inertia = (b * b + h * h) * 4.0 / 3.0;
    let before = (2.0 * g * fall / inertia).sqrt();
    close(after / before, 0.911_764_705_882_352_9, 1e-12);

    let run = simulate("machines/contacts/rocking_block.machine", 4.0, &[]);
    is_good(&run);
    // By Housner's formulas the seventh is at about 3.95 s, and the eighth 0.36 s later.
    assert_eq!(events(&run, "impact").len(), 7, "{run:#}");
    close(number(&run["energy_residual"]), 0.0, 1e-9);
}

/// Moving walls do work on the ball: the ball leaves a wall with e times the relative velocity of its approach, and the energy balance includes the
/// work of the walls.
#[test]
fn the_walls_of_a_shaken_box_work_on_the_ball() {
    let run = simulate("machines/contacts/shaken_box.machine", 3.0, &[]);
    is_good(&run);
    let impacts = events(&run, "impact");
    assert!(impacts.len() > 20);
    for impact in impacts {
        let [before, after] = [0, 1].map(|k| number(&impact["gap_rate"][k]));
        close(after, -0.9 * before, 1e-13);
    }
    close(number(&run["energy_residual"]), 0.0, 1e-12);
}

/// E. J. Routh: a ball that is thrown with the speed v and slips at u = v + rω rolls after 2u/(7μg), at v − 2u/7; by then friction has
/// dissipated m u²/7.
#[test]
fn a_ball_slips_until_it_rolls() {
    let (m, r, mu, g, v) = (7.0, 0.108, 0.1, 9.81, 8.0);
    // Without spin, thrown with back spin, and with so much that it rolls back.
    for spin in [0.0, 30.0, 300.0] {
        let u = v + r * spin;
        let until = 2.0 * u / (7.0 * mu * g);
        let spec = "machines/contacts/bowling_ball.machine";
        let run = simulate(spec, until + 1.0, &[&format!("spin={spin}")]);
        is_good(&run);
        let sticks = events(&run, "sticks");
        assert_eq!(sticks.len(), 1, "{run:#}");
        close(number(&sticks[0]["t"]), until, 1e-12 * (1.0 + until));
        let rolls = v - 2.0 * u / 7.0;
        close(number(&run["v"]["x"]), rolls, 1e-12 * u);
        close(number(&run["v"]["theta"]), -rolls / r, 1e-11 * u / r);
        close(
            number(&run["dissipated"]),
            m * u * u / 7.0,
            1e-11 * m * u * u,
        );
    }
}

/// A disc that rolls off a round hump from the angle φ₀ begins to slip where its friction, mg sin φ/3, reaches the limit μ mg (7 cos φ − 4 cos φ₀)/3.
/// Without friction it leaves the hump at cos φ = ⅔ cos φ₀ and flies along a parabola.
#[test]
fn a_disc_slips_on_a_hump_and_leaves_it() {
    let spec = "machines/contacts/disc_over_hump.machine";
    let (m, r, length, tilt, mu, g) = (0.2, 0.05, 0.55, 0.1_f64, 0.5, 9.81);
    let angle = |event: &Value| number(&event["q"]["x"]).atan2(number(&event["q"]["y"]));

    let run = simulate(spec, 1.0, &[]);
    is_good(&run);
    let reserve = |phi: f64| mu * (7.0 * phi.cos() - 4.0 * tilt.cos()) - phi.sin();
    let (mut low, mut high) = (tilt, PI / 2.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if reserve(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    let slips = events(&run, "slips");
    close(angle(slips[0]), low, 1e-10);
    let lifts = events(&run, "lifts");
    assert_eq!(lifts[0]["contact"], "top");
    assert!(angle(lifts[0]) > low, "{run:#}");

    let run = simulate(spec, 1.0, &["mu=0"]);
    is_good(&run);
    let lifts = events(&run, "lifts");
    let leaves = (2.0 / 3.0 * tilt.cos()).acos();
    close(angle(lifts[0]), leaves, 1e-10);
    let speed = (g * length * leaves.cos()).sqrt();
    let (down, height) = (speed * leaves.sin(), length * leaves.cos() - r);
    let fall = ((down * down + 2.0 * g * height).sqrt() - down) / g;
    let impacts = events(&run, "impact");
    assert_eq!(impacts[0]["contact"], "floor");
    let flight = number(&impacts[0]["t"]) - number(&lifts[0]["t"]);
    close(flight, fall, 1e-10);
    // The impact does not change the velocity along the ground.
    let lost = 0.5 * m * (down * down + 2.0 * g * height);
    close(number(&run["impact_loss"]), lost, 1e-9);
}

/// A level dimer follows its plate as a single ball does: both ends stick, lift off and land together, although their friction forces along the rod
/// depend on each other. It leaves the plate when the downward acceleration of the plate reaches g.
#[test]
fn both_ends_of_a_level_dimer_lift_together() {
    let spec = "machines/contacts/dimer.machine";
    let dimer = simulate(spec, 0.06, &[]);
    is_good(&dimer);
    let ball = Scratch::new(
        "ball.machine",
        "machine Ball in plane {
            parameters {
                m: kg = 0.0012, h: m = 0.002, A: m = 0.0008, w: rad/s = 157.07963267948966, e: 1 = 0.5, g: m/s^2 = 9.81,
            }
            coordinates { y: m = h }
            bodies { ball { mass: m, at: (0, y) } }
            gravity (0, -g);
            contacts { plate { gap: y - A*sin(w*t), restitution: e } }
        }",
    );
    let ball = simulate(ball.path(), 0.06, &[]);
    is_good(&ball);
    let omega: f64 = 157.079_632_679_489_66;
    let leaves = (2.0 * PI + (9.81 / (0.0008 * omega * omega)).asin()) / omega;
    let lifts = events(&dimer, "lifts");
    assert_eq!(lifts.len(), 2, "{dimer:#}");
    for lift in &lifts {
        close(number(&lift["t"]), leaves, 1e-9);
    }
    let (of_dimer, of_ball) = (events(&dimer, "impact"), events(&ball, "impact"));
    assert_eq!(of_dimer.len(), 2 * of_ball.len());
    for (pair, single) in of_dimer.chunks(2).zip(&of_ball) {
        for impact in pair {
            close(number(&impact["t"]), number(&single["t"]), 1e-9);
        }
    }
    close(
        number(&dimer["q"]["y"]) - 0.0025,
        number(&ball["q"]["y"]),
        1e-9,
    );
    close(number(&dimer["q"]["x"]), 0.0, 1e-12);
    close(number(&dimer["q"]["theta"]), 0.0, 1e-9);

    // Without friction nothing moves the mass centre sideways, however the dimer tumbles.
    let tumbling = simulate(spec, 0.2, &["tilt=0.3", "h=0.004", "mu=0"]);
    is_good(&tumbling);
    assert!(events(&tumbling, "impact").len() > 5);
    close(number(&tumbling["q"]["x"]), 0.0, 1e-12);
}

/// The crusher's first twelve impacts without friction, computed independently in quadruple precision: time, contact, rate of the gap and impulse.
#[test]
fn the_crusher_collides_as_it_does_in_quadruple_precision() {
    #[rustfmt::skip]
    let expected = [
        (0.019471480922661894, "outer", -1.5365004636274473, 323.7866723895882),
        (0.03460440805285144, "outer", -1.8092577873164208, 381.26418339933065),
        (0.03935701266501024, "inner", -1.3957246892162274, 150.73826643535256),
        (0.04246405269336595, "outer", -0.8220855203862831, 173.23798462895166),
        (0.045084914799001126, "outer", -0.4446716505652894, 93.7045078528406),
        (0.04629611117399249, "outer", -0.22928721743429137, 48.31685779983615),
        (0.04687908566385473, "outer", -0.116231886274906, 24.493071199609386),
        (0.04716509851575288, "outer", -0.05849615061985774, 12.326644598012823),
        (0.04730675494231375, "outer", -0.02934112913018417, 6.182928738820974),
        (0.047377247765092854, "outer", -0.014693584970983449, 3.096314792793467),
        (0.047412410580191, "outer", -0.007352517620427718, 1.5493636913647977),
        (0.04742997111934686, "outer", -0.00367768637390102, 0.774982635999659),
    ];
    let run = simulate(
        "machines/contacts/colliding_crusher.machine",
        0.05,
        &["mu=0"],
    );
    is_good(&run);
    for (impact, (t, contact, rate, impulse)) in events(&run, "impact").iter().zip(expected) {
        assert_eq!(impact["contact"], contact);
        close(number(&impact["t"]), t, 1e-13);
        close(number(&impact["gap_rate"][0]), rate, 1e-11);
        close(number(&impact["impulse"][0]), impulse, 1e-9 * impulse);
    }
    let closes = events(&run, "closes");
    // The limit that twelve impacts extrapolate to, to the seven digits that they determine.
    close(number(&closes[0]["t"]), 0.04744749, 5e-8);
}

/// With friction, until the motion settles: no penetration exceeds the tolerance, no contact force is tensile, and the energy balance closes.
#[test]
fn the_crusher_runs_for_a_second_with_friction() {
    let run = simulate("machines/contacts/colliding_crusher.machine", 1.0, &[]);
    is_good(&run);
    assert!(events(&run, "impact").len() > 50);
    for event in events(&run, "impact") {
        assert!(number(&event["gap_rate"][1]) >= -1e-12, "{event}");
        let [normal, tangential] = [0, 1].map(|k| number(&event["impulse"][k]));
        // Bodies of up to 600 kg at some m/s: the rounding of their momenta, 2⁻⁵³ · 10³ N s, affects impulses that are far smaller.
        assert!(
            normal >= 0.0 && tangential.abs() <= 0.3 * normal * (1.0 + 1e-9) + 1e-13,
            "{event}"
        );
    }
    // Relative to about 10⁴ J of exchanged energy.
    close(number(&run["energy_residual"]), 0.0, 1e-6);
}

/// A block on a belt, held by a spring: the period of stick and slip in closed form, with a unilateral contact.
#[test]
fn a_block_on_a_belt_sticks_and_slips_in_time() {
    let spec = Scratch::new(
        "belt.machine",
        "machine Belt in plane {
            coordinates { x: m, y: m, der(x): m/s = 0.2 }
            bodies { block { mass: 1, at: (x, y) } }
            gravity (0, -1);
            springs { spring { stiffness: 1, stretch: x } }
            contacts {
                belt { gap: y, slip: der(x) - 0.2, restitution: 0, friction: 0.5, static_friction: 1 }
            }
        }",
    );
    let run = simulate(spec.path(), 20.0, &[]);
    is_good(&run);
    let (slips, sticks) = (events(&run, "slips"), events(&run, "sticks"));
    close(number(&slips[0]["t"]), 5.0, 1e-12);
    close(number(&slips[0]["q"]["x"]), 1.0, 1e-12);
    let slip = number(&sticks[0]["t"]) - number(&slips[0]["t"]);
    close(slip, 3.902_605_407_814_523, 1e-10);
    let period = number(&slips[1]["t"]) - number(&slips[0]["t"]);
    close(period, 8.902_605_407_814_523, 1e-10);
    close(number(&run["energy_residual"]), 0.0, 1e-10);
}

/// A box that rests on two corners shares its load between them, and the one that presses less has no friction left before the other. The box is held
/// by the static friction of both: it rests on every slope below μ₀.
#[test]
fn a_box_is_held_by_the_static_friction_of_both_corners() {
    let on = |contact: &str| {
        format!(
            "machine Box in plane {{
                parameters {{
                    m: kg = 2, w: m = 0.4, h: m = 0.1, mu: 1 = 0.3, mu0: 1 = 0.36, g: m/s^2 = 9.81, alpha: rad = 0,
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
                contacts {{ base {{ {contact}, restitution: 0, friction: mu, static_friction: mu0 }} }}
            }}"
        )
    };
    for (name, contact) in [
        (
            "corners.machine",
            "corners: outline, on: carton, along: slope",
        ),
        (
            "faces.machine",
            "corners: outline, on: carton, against: ((-5, -1), (5, -1), (5, 0), (-5, 0)), of: slope",
        ),
    ] {
        let spec = Scratch::new(name, &on(contact));
        for tangent in ["0.31", "0.35", "0.3599"] {
            let run = simulate(spec.path(), 1.0, &[&format!("alpha=atan({tangent})")]);
            is_good(&run);
            // Rounding over one second of rest.
            close(number(&run["q"]["x"]), 0.0, 1e-12);
        }
    }
}

/// A puck lies on a plate that slides on the floor in space, both between guides: it does not slip on the plate, and both stop together after v/(μ g) and
/// v²/(2 μ g), where the friction of neither depends on that of the other.
#[test]
fn a_plate_stops_under_its_puck_in_space() {
    let spec = Scratch::new(
        "plate.machine",
        "machine Plate in space {
            coordinates { a: m, b: m, x: m = 0.3, y: m = 0.2, der(a): m/s = -1 }
            frames { slab = ground.shift(a, b, 0) }
            bodies { plate { mass: 1, frame: slab }, puck { mass: 0.4, at: slab.point(x, y, 0.1) } }
            gravity (0, 0, -9.81);
            sliding {
                low { body: plate, on: ground, normal: (0, 0, 1), friction: 0.1 },
                up { body: puck, on: slab, normal: (0, 0, 1), friction: 0.3 },
            }
        }",
    );
    let run = simulate(spec.path(), 2.0, &[]);
    is_good(&run);
    let events = run["events"].as_array().expect("events");
    assert_eq!(events.len(), 1, "{events:?}");
    assert_eq!(events[0]["name"], "low sticks");
    close(number(&events[0]["t"]), 1.0 / 0.981, 1e-9);
    close(number(&run["q"]["a"]), -0.5 / 0.981, 1e-9);
    close(number(&run["q"]["x"]), 0.3, 1e-12);
}

/// Two blocks on a rod are held by the static friction of both, up to μ₀ (m + M) g, here 10 N; above that they slip with (F − μ (m + M) g)/(m + M).
#[test]
fn two_blocks_on_a_rod_are_held_by_the_static_friction_of_both() {
    let spec = Scratch::new(
        "rod.machine",
        "machine Rod in plane {
            parameters { F: N = 0 }
            coordinates { x: m, y: m = 1, u: m, w: m }
            bodies { a { mass: 1, at: (x, u) }, b { mass: 1, at: (y, w) } }
            gravity (0, -10);
            forces { push { at: a.at, force: (F, 0) } }
            constraints { rod: y - x = 1 }
            contacts {
                under_a { gap: u, slip: der(x), restitution: 0, friction: 0.3, static_friction: 0.5 },
                under_b { gap: w, slip: der(y), restitution: 0, friction: 0.3, static_friction: 0.5 },
            }
        }",
    );
    for (force, slipped) in [
        ("F=4", 0.0),
        ("F=8.5", 0.0),
        ("F=9.9", 0.0),
        ("F=10.1", 1.025),
    ] {
        let run = simulate(spec.path(), 1.0, &[force]);
        is_good(&run);
        // Rounding over one second.
        close(number(&run["q"]["x"]), slipped, 1e-12);
    }
}

/// A body that slides on a plane with friction μ and then rolls: a sphere rolls at 5/7 of its initial speed, a disc at 2/3, after v₀/(3 μ g).
#[test]
fn a_disc_slides_until_it_rolls() {
    let spec = Scratch::new(
        "disc.machine",
        "machine Disc in plane {
            parameters { m: kg = 2, r: m = 0.1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m = r, theta: rad, der(x): m/s = 3 }
            bodies { disc { mass: m, inertia: m*r^2/2, at: (x, y), angle: theta } }
            gravity (0, -g);
            circles { rim { on: disc, center: (0, 0), radius: r } }
            contacts { floor { circle: rim, along: ground, restitution: 0.5, friction: mu } }
        }",
    );
    let run = simulate(spec.path(), 2.0, &[]);
    is_good(&run);
    let sticks = events(&run, "sticks");
    assert_eq!(sticks.len(), 1);
    close(number(&sticks[0]["t"]), 3.0 / (3.0 * 0.2 * 9.81), 1e-12);
    close(number(&run["v"]["x"]), 2.0, 1e-12);
    close(number(&run["v"]["theta"]), -20.0, 1e-11);
    // It stays on the floor up to round-off.
    close(number(&run["q"]["y"]), 0.1, 1e-15);
}

/// A disc that falls flat on a plane by Newton's, Poisson's and Stronge's laws: without coupling between the normal and tangential directions they
/// agree, and the tangential impulse is the one of sticking or the limit of friction.
#[test]
fn laws_agree_where_nothing_couples_normal_and_tangent() {
    for law in ["newton", "poisson", "poisson_glocker", "stronge"] {
        let spec = Scratch::new(
            "law.machine",
            &format!(
                "machine Law in plane {{
                    parameters {{ m: kg = 2, r: m = 0.1, g: m/s^2 = 9.81 }}
                    coordinates {{ x: m, y: m = r + 1, theta: rad, der(x): m/s = 30 }}
                    bodies {{ disc {{ mass: m, inertia: m*r^2/2, at: (x, y), angle: theta }} }}
                    gravity (0, -g);
                    circles {{ rim {{ on: disc, center: (0, 0), radius: r }} }}
                    contacts {{ floor {{ circle: rim, along: ground, restitution: 0.5, friction: 0.2, law: {law} }} }}
                }}"
            ),
        );
        let run = simulate(spec.path(), 0.5, &[]);
        assert_eq!(run["error"], Value::Null, "{run:#}");
        let impact = events(&run, "impact")[0];
        let speed = (2.0 * 9.81_f64).sqrt();
        close(number(&impact["impulse"][0]), 2.0 * 1.5 * speed, 1e-12);
        close(
            number(&impact["impulse"][1]),
            -0.2 * 2.0 * 1.5 * speed,
            1e-12,
        );
        close(number(&impact["gap_rate"][1]), 0.5 * speed, 1e-12);
    }
}

/// A slanting rod with e = 0.9 and μ = 0.3 gains energy by Newton's law, which is reported, and none by Stronge's.
#[test]
fn energy_that_newtons_law_creates_is_told() {
    let rod = |law: &str, tilt: f64| {
        Scratch::new(
            "rod.machine",
            &format!(
                "machine Rod in plane {{
                    coordinates {{ x: m, y: m = 0.01 + sin({tilt}), theta: rad = {tilt}, der(y): m/s = -1, der(x): m/s = 0.8 }}
                    bodies {{ rod {{ mass: 1, inertia: 1/3, at: (x, y), angle: theta }} }}
                    contacts {{
                        tip {{ point: (-1, 0), on: rod, along: ground, restitution: 0.9, friction: 0.3, law: {law} }}
                    }}
                }}"
            ),
        )
    };
    let mut gained = 0;
    for tilt in [0.3, 0.7, 0.9, 1.1] {
        let run = simulate(rod("newton", tilt).path(), 0.05, &[]);
        let loss = number(&run["impact_loss"]);
        let told = run["warnings"].as_array().map_or(0, Vec::len);
        assert_eq!(told > 0, loss < -1e-12, "{run:#}");
        gained += told;
        let run = simulate(rod("stronge", tilt).path(), 0.05, &[]);
        assert!(number(&run["impact_loss"]) > 0.0, "{run:#}");
        is_good(&run);
    }
    assert!(gained > 0);
}

/// Painlevé's rod ends the run with an error that names its contact and the state; below a friction of 4/3 it runs.
#[test]
fn a_rod_on_rough_ground_is_a_paradox_by_name() {
    let run = simulate("machines/contacts/painleve_rod.machine", 0.3, &[]);
    is_good(&run);
    let run = simulate("machines/contacts/painleve_rod.machine", 1.0, &["mu=3"]);
    let error = run["error"].as_str().unwrap_or_default();
    assert!(
        error.contains("the contact `tip`") && error.contains("Painlevé"),
        "{run:#}"
    );
}

/// Two corners of a box that falls flat meet the ground at once. A box on three collinear feet stands although the distribution of the
/// load is undetermined.
#[test]
fn several_contacts_meet_and_share_a_load() {
    let spec = Scratch::new(
        "feet.machine",
        "machine Feet in plane {
            parameters { e: 1 = 0, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m = 1.5, theta: rad, der(x): m/s = 1 }
            bodies { box { mass: 3, inertia: 0.5, at: (x, y), angle: theta } }
            gravity (0, -g);
            contacts {
                left   { point: (-0.5, -0.5), on: box, along: ground, restitution: e, friction: 0.3 },
                middle { point: (0.1, -0.5), on: box, along: ground, restitution: e, friction: 0.3 },
                right  { point: (0.5, -0.5), on: box, along: ground, restitution: e, friction: 0.3 },
            }
        }",
    );
    let run = simulate(spec.path(), 2.0, &[]);
    assert_eq!(run["error"], Value::Null, "{run:#}");
    let fall = (2.0 / 9.81_f64).sqrt();
    close(number(&events(&run, "impact")[0]["t"]), fall, 1e-13);
    close(number(&run["q"]["y"]), 0.5, 1e-12);
    close(number(&run["q"]["theta"]), 0.0, 1e-12);
    // Friction stops it during the impact, because μ times the impulse exceeds its momentum.
    close(number(&run["q"]["x"]), fall, 1e-12);
    close(number(&run["energy_residual"]), 0.0, 1e-9);
}

/// A ball that just touches a ceiling, and one that just misses it.
#[test]
fn grazing_is_neither_missed_nor_doubled() {
    for (height, impacts) in [(1.0 + 1e-9, 0), (1.0 - 1e-9, 1)] {
        let spec = Scratch::new(
            "graze.machine",
            &format!(
                "machine Graze in plane {{
                    coordinates {{ y: m, der(y): m/s = sqrt(2*9.81) }}
                    bodies {{ ball {{ mass: 1, at: (0, y) }} }}
                    gravity (0, -9.81);
                    contacts {{ ceiling {{ gap: {height:?} - y, restitution: 0.5 }} }}
                }}"
            ),
        );
        let run = simulate(spec.path(), 0.8, &[]);
        is_good(&run);
        assert_eq!(events(&run, "impact").len(), impacts, "{run:#}");
    }
}

/// A rod, at the angle φ to a smooth floor and not turning, lands with its lower end, which does not bounce: the rate at which this gap
/// opens is then only rounding. But the rod turns, at `3 v cos φ/((1 + 3 cos² φ) l)`, so that the end leaves the floor by its
/// acceleration and comes back at the angle φ − u with `sin φ − u cos φ = sin(φ − u)`, all within one step.
#[test]
fn what_opens_by_its_acceleration_alone_has_opened() {
    for k in 1..=14 {
        let angle = 0.05 * f64::from(k);
        let (sin, cos) = angle.sin_cos();
        let turn = 3.0 * 2.0 * cos / ((1.0 + 3.0 * cos * cos) * 0.5);
        let over = |u: f64| sin - u * cos - (angle - u).sin();
        let [mut from, mut to] = [1.5 * angle, 3.0];
        assert!(over(from) > 0.0 && over(to) < 0.0);
        for _ in 0..60 {
            let middle = f64::midpoint(from, to);
            let half = if over(middle) > 0.0 {
                &mut from
            } else {
                &mut to
            };
            *half = middle;
        }
        let back = 1.0 + from / turn;
        let spec = Scratch::new(
            "rod.machine",
            &format!(
                "machine Rod in plane {{
                    parameters {{ m: kg = 2, l: m = 0.5, v: m/s = 2, T: s = 1 }}
                    coordinates {{ x: m, y: m = l*sin({angle:?}) + v*T, phi: rad = {angle:?}, der(y): m/s = -v }}
                    frames {{ rod = ground.shift(x, y).turn(phi) }}
                    bodies {{ rod {{ mass: m, inertia: m*l^2/3, frame: rod }} }}
                    gravity none;
                    contacts {{ floor {{ point: (-l, 0), on: rod, along: ground, restitution: 0 }} }}
                }}"
            ),
        );
        let run = simulate(spec.path(), back + 0.01, &[]);
        is_good(&run);
        let impacts = events(&run, "impact");
        assert_eq!(impacts.len(), 2, "{angle}: {run:#}");
        close(number(&impacts[0]["t"]), 1.0, 1e-14);
        close(number(&impacts[1]["t"]), back, 1e-12);
    }
}

/// A start with penetration is reported as an error; a start on the surface is not an impact.
#[test]
fn a_start_inside_of_something_is_an_error() {
    let run = simulate("machines/contacts/bouncing_ball.machine", 0.1, &[]);
    is_good(&run);
    let spec = Scratch::new(
        "inside.machine",
        "machine Inside in plane {
            coordinates { y: m = -0.1 }
            bodies { ball { mass: 1, at: (0, y) } }
            contacts { floor { gap: y, restitution: 0.5 } }
        }",
    );
    let output = lagrangian(&["simulate", spec.path(), "--until", "1"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        !output.status.success() && said.contains("`floor`"),
        "{said}"
    );
    assert!(
        said.contains("its gap is negative, which is penetration"),
        "{said}"
    );
}

/// Random discs of random masses in a box without gravity: with e = 1 energy is conserved, nothing leaves the box, and no disc
/// passes through another.
#[test]
fn random_discs_in_a_box_keep_their_energy() {
    let clock = std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .map_or(1, |since| since.subsec_nanos() as u64);
    let seed = std::env::var("SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let seed = seed.unwrap_or(clock) | 1;
    println!("SEED={seed}");
    let mut state: u64 = seed;
    let mut drawn = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    for _ in 0..3 {
        let mut coordinates = String::new();
        let mut bodies = String::new();
        let mut contacts = String::new();
        let mut radii = Vec::new();
        for k in 0..3 {
            let radius = 0.05 + 0.1 * drawn();
            let (x, y) = (-0.6 + 0.6 * k as f64, -0.5 + drawn());
            let [vx, vy] = [0, 1].map(|_| 2.0 * drawn() - 1.0);
            coordinates.push_str(&format!(
                "x{k}: m = {x:?}, y{k}: m = {y:?}, der(x{k}): m/s = {vx:?}, der(y{k}): m/s = {vy:?},\n"
            ));
            let mass = 0.5 + drawn();
            bodies.push_str(&format!("d{k} {{ mass: {mass:?}, at: (x{k}, y{k}) }},\n"));
            for (wall, gap) in [
                ("e", format!("1 - x{k} - {radius:?}")),
                ("w", format!("1 + x{k} - {radius:?}")),
                ("n", format!("1 - y{k} - {radius:?}")),
                ("s", format!("1 + y{k} - {radius:?}")),
            ] {
                contacts.push_str(&format!("{wall}{k} {{ gap: {gap}, restitution: 1 }},\n"));
            }
            for (other, other_radius) in radii.iter().enumerate() {
                let sum: f64 = radius + other_radius;
                contacts.push_str(&format!(
                    "p{k}_{other} {{ gap: sqrt((x{k} - x{other})^2 + (y{k} - y{other})^2) - {sum:?}, restitution: 1 }},\n"
                ));
            }
            radii.push(radius);
        }
        let spec = Scratch::new(
            "discs.machine",
            &format!(
                "machine Discs in plane {{
                    coordinates {{ {coordinates} }}
                    bodies {{ {bodies} }}
                    contacts {{ {contacts} }}
                }}"
            ),
        );
        let run = simulate(spec.path(), 10.0, &[]);
        assert_eq!(run["error"], Value::Null, "seed {seed}: {run:#}");
        let impacts = events(&run, "impact");
        assert!(!impacts.is_empty(), "seed {seed}");
        let energy_lost = number(&run["impact_loss"]).abs();
        // Each impact rounds an energy of about 1 J about ten times.
        assert!(
            energy_lost < 1e-14 * impacts.len() as f64,
            "seed {seed}: {energy_lost}"
        );
        assert!(number(&run["energy_residual"]).abs() < 1e-12, "seed {seed}");
        for (k, radius) in radii.iter().enumerate() {
            for axis in ["x", "y"] {
                let place = number(&run["q"][format!("{axis}{k}")]);
                assert!(place.abs() <= 1.0 - radius + 1e-12, "seed {seed}");
            }
        }
    }
}

/// A box that slides towards the edge of a step tips when the resultant of the normal force would pass the edge because of friction, at x = −μ h. It
/// then tumbles from step to step without penetrating one, and comes to rest: its entire initial energy, including that of its height, is dissipated.
#[test]
fn a_box_tumbles_down_a_stair() {
    let spec = "machines/contacts/box_on_stair.machine";
    let run = simulate(spec, 2.0, &[]);
    is_good(&run);
    let (m, h, mu, g, start, speed) = (2.0, 0.08, 0.4, 9.81, -0.05, 1.2);
    let tips = (speed - f64::sqrt(speed * speed + 2.0 * mu * g * (start + mu * h))) / (mu * g);
    let lifts = events(&run, "lifts");
    assert_eq!(lifts[0]["contact"], "r[1]");
    // Forces are accurate to 1e-11 of their terms, and so is the instant at which one vanishes.
    close(number(&lifts[0]["t"]), tips, 1e-11);
    close(number(&lifts[0]["q"]["x"]), -mu * h, 1e-11);
    // It rests upside down on the lowest step.
    close(number(&run["q"]["theta"]), -PI, 1e-12);
    close(number(&run["q"]["y"]), 0.18 + h, 1e-12);
    let had = 0.5 * m * speed * speed + m * g * 2.0 * 0.18;
    close(number(&run["dissipated"]), had, 1e-9 * had);
    let lost = number(&run["impact_loss"]);
    assert!(lost > 0.0 && lost < had, "{lost}");

    let table = Scratch::new("stair.csv", "");
    std::fs::remove_file(table.path()).expect("removed");
    let output = lagrangian(&[
        "simulate",
        spec,
        "--until",
        "1",
        "--every",
        "0.002",
        "--out",
        table.path(),
    ]);
    assert!(output.status.success());
    let text = std::fs::read_to_string(table.path()).expect("table");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("header").split(',').collect();
    let gaps: Vec<usize> = (0..names.len())
        .filter(|k| names[*k].contains("gap("))
        .collect();
    assert_eq!(gaps.len(), 4 + 3 + 12);
    for line in lines {
        let row: Vec<f64> = line
            .split(',')
            .map(|x| x.parse().expect("number"))
            .collect();
        for &k in &gaps {
            // Dense output is as accurate as the tolerance of a step, 1e-9.
            assert!(row[k] > -1e-9, "{} = {} at {}", names[k], row[k], row[0]);
        }
    }
}

/// Without its debalance and with the pestle in its middle, the mortar flies through the axis of the cylinder, where polar coordinates are singular;
/// in relative coordinates it moves as in its own.
#[test]
fn a_mortar_passes_through_the_centre_in_either_coordinates() {
    let run = |spec: &str, starts: [&str; 4], rates: [&str; 2]| -> Value {
        let mut arguments = vec!["simulate", spec, "--until", "0.15", "--json"];
        arguments.extend(["--tolerance", "1e-13", "--set", "m0=0"]);
        arguments.extend(starts.iter().flat_map(|start| ["--start", start]));
        arguments.extend(rates.iter().flat_map(|rate| ["--rate", rate]));
        let output = lagrangian(&arguments);
        serde_json::from_slice(&output.stdout).expect("a document")
    };
    let own = run(
        "machines/contacts/colliding_crusher.machine",
        ["x1=-0.004", "y1=0", "x2=-0.004", "y2=0"],
        ["x1=0.4", "x2=0.4"],
    );
    let relative = run(
        "machines/contacts/relative_crusher.machine",
        ["xi1=-0.004", "eta1=0", "xi2=0", "eta2=0"],
        ["xi1=0.4", "xi2=0"],
    );
    let [first, second] = [&own, &relative].map(|run| events(run, "impact"));
    assert_eq!(first.len(), second.len());
    // It travels 0.024 m at 0.4 m/s, and passes the axis 0.01 s after the start.
    close(number(&first[0]["t"]), 0.06, 1e-12);
    for (own, relative) in first.iter().zip(&second) {
        close(number(&own["t"]), number(&relative["t"]), 1e-12);
    }
    let q = |run: &Value, name: &str| number(&run["q"][name]);
    let mortar = q(&relative, "x") + q(&relative, "xi1");
    close(q(&own, "x1"), mortar, 1e-12);
    close(q(&own, "x2"), mortar + q(&relative, "xi2"), 1e-12);
}

/// The height of a bouncing ball touches 0 at each impact and stays there where the bounces have accumulated; its rate changes its sign at each impact
/// and at each highest place: at √(2h/g) (1 + 2e + …), and eᵏ √(2h/g) later.
#[test]
fn a_height_that_touches_the_floor_does_not_cross_it() {
    let ball = "machines/contacts/bouncing_ball.machine";
    let section = |until: &str, more: &[&str]| {
        let call = [
            "section",
            ball,
            "--json",
            "--direction",
            "both",
            "--until",
            until,
        ];
        let output = lagrangian(&[&call, more].concat());
        let text = String::from_utf8(output.stdout).expect("text");
        let found: Value = serde_json::from_str(&text).expect("JSON");
        let times = found["t"].as_array().expect("times").iter();
        times.map(number).collect::<Vec<f64>>()
    };
    let first = (2.0 / 9.81_f64).sqrt();
    for method in ["dop853", "dopri5", "bs32", "radau5"] {
        assert_eq!(
            section("2.5", &["--crossing", "y", "--method", method]),
            [0.0; 0]
        );
        let rates = section("2.5", &["--crossing", "der(y)", "--method", method]);
        let (mut impact, mut expected) = (first, Vec::new());
        for k in 1.. {
            expected.extend([impact, impact + 0.8_f64.powi(k) * first]);
            impact += 2.0 * 0.8_f64.powi(k) * first;
            if impact > 2.5 {
                break;
            }
        }
        expected.retain(|t| *t < 2.5);
        assert_eq!(rates.len(), expected.len(), "{rates:?} {expected:?}");
        for (found, expected) in rates.iter().zip(expected) {
            close(*found, expected, 1e-9);
        }
    }
    let last = section("5", &["--crossing", "y"]);
    assert_eq!(last.len(), 1);
    close(last[0], 9.0 * first, 1e-7);
}

/// Contact events are in the order of time, also where the rest of bounces is added to the time at which they end.
#[test]
fn contact_events_come_in_order() {
    for (machine, until) in [
        ("box_on_stair", 1.0),
        ("dropped_box", 1.0),
        ("colliding_crusher", 1.0),
    ] {
        let spec = format!("machines/contacts/{machine}.machine");
        let run = simulate(&spec, until, &[]);
        for events in ["contact_events", "events"] {
            let all = run[events].as_array().expect("events");
            let times: Vec<f64> = all.iter().map(|event| number(&event["t"])).collect();
            assert!(times.is_sorted(), "{machine} {events}");
            assert!(times.iter().all(|t| *t <= until), "{machine} {events}");
        }
    }
}

/// Bodies that come together with restitution 0 and that nothing pushes stay together: their momentum was 0, so that they are at rest, and
/// what they had is lost. The discs meet where their centres form a regular polygon with sides 2r.
#[test]
fn discs_that_come_together_stay() {
    let spec = Scratch::new(
        "discs.machine",
        "machine Discs in plane {
            constants { N = 3 }
            parameters { m: kg = 1, r: m = 0.1, s: m = 0.3, v: m/s = 1, u: m/s = 0 }
            coordinates {
                x[i in 1..N]: m = s*cos(2*pi*i*rad/N), y[i in 1..N]: m = s*sin(2*pi*i*rad/N),
                der(x[i in 1..N]): m/s = u - v*cos(2*pi*i*rad/N), der(y[i in 1..N]): m/s = -v*sin(2*pi*i*rad/N),
            }
            bodies { disc[i in 1..N] { mass: m, at: (x[i], y[i]) } }
            gravity none;
            circles { rim[i in 1..N] { on: disc[i], center: (0, 0), radius: r } }
            contacts { pair { circles: rim, restitution: 0 } }
        }",
    );
    for n in 2..8 {
        for u in ["0", "0.3"] {
            let constant = format!("N={n}");
            let call = [
                "simulate",
                spec.path(),
                "--until",
                "1",
                "--json",
                "--const",
                &constant,
            ];
            let output = lagrangian(
                &[
                    &call[..],
                    &["--method", "dop853", "--set", &format!("u={u}")],
                ]
                .concat(),
            );
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{n} {u}: {said}");
            let run: Value = serde_json::from_slice(&output.stdout).expect("JSON");
            close(number(&run["impact_loss"]), 0.5 * f64::from(n), 1e-12);
            let meets = 0.3 - 0.1 / (PI / f64::from(n)).sin();
            let first = &events(&run, "impact")[0];
            close(number(&first["t"]), meets, 1e-12);
            let speed: f64 = u.parse().expect("a number");
            for i in 1..=n {
                close(number(&run["v"][format!("x[{i}]")]), speed, 1e-11);
                close(number(&run["v"][format!("y[{i}]")]), 0.0, 1e-11);
            }
        }
    }
}

/// Two equal boxes exactly on top of each other, the upper one sliding off, on a floor whose friction holds the lower one exactly: it is pushed by
/// `μ m g`, and held as long as this is at most `μ₀ (m + M) g`. The upper one is braked by `μ g`.
#[test]
fn a_box_slides_off_an_equal_one() {
    for (b, h, until) in [
        ("0.3", "0.1", 0.1),
        ("0.3", "0.1", 0.3),
        ("0.2", "0.05", 0.1),
        ("0.4", "0.1", 0.2),
    ] {
        let sizes = [
            format!("b={b}"),
            format!("B={b}"),
            format!("h={h}"),
            format!("H={h}"),
        ];
        let mut settings: Vec<&str> = sizes.iter().map(String::as_str).collect();
        settings.extend(["mu=0.5", "mu_floor=0.3", "m=1", "M=1", "speed=1", "e=0.5"]);
        let run = simulate("machines/contacts/box_on_box.machine", until, &settings);
        assert_eq!(run["error"], Value::Null, "{b} {h}: {}", run["error"]);
        let stops = 1.0 / (0.5 * 9.81);
        let t = until.min(stops);
        close(number(&run["q"]["X"]), 0.0, 1e-12);
        close(number(&run["q"]["x"]), t - 0.25 * 9.81 * t * t, 1e-11);
    }
}

/// A rigid contact that is penetrated is told with its depth; one that touches, or yields, is not.
#[test]
fn evaluate_tells_what_is_penetrated() {
    let evaluate = |spec: &str, y: &str| {
        let output = lagrangian(&["evaluate", spec, "--start", &format!("y={y}")]);
        serde_json::from_slice::<Value>(&output.stdout).expect("JSON")[0]["warnings"].clone()
    };
    let ball = "machines/contacts/bouncing_ball.machine";
    for y in ["0", "1"] {
        assert_eq!(evaluate(ball, y), Value::Null, "{y}");
    }
    let said = evaluate(ball, "-0.25");
    let said = said[0].as_str().expect("a warning");
    assert!(
        said.contains("the contact `floor` is penetrated by 0.25 m"),
        "{said}"
    );
}

/// Of many contacts the summary names those that were closed, and counts the others: 8 discs, which fall freely for 50 ms, and later meet the bowl and each other.
#[test]
fn contacts_that_were_open_throughout_are_counted() {
    for (until, all_are_open) in [("0.05", true), ("0.4", false)] {
        let output = lagrangian(&[
            "simulate",
            "machines/contacts/pile.machine",
            "--const",
            "N=8",
            "--until",
            until,
        ]);
        let text = String::from_utf8(output.stdout).expect("text");
        let named = text.lines().filter(|line| line.contains(" at the end"));
        let named = named.filter(|line| line.contains("impact")).count();
        let counted = text.lines().find_map(|line| {
            let (count, _) = line.split_once(" contacts were open throughout")?;
            count.trim().parse::<usize>().ok()
        });
        assert_eq!(named + counted.unwrap_or(0), 36, "{text}");
        assert_eq!(named == 0, all_are_open, "{text}");
    }
}
