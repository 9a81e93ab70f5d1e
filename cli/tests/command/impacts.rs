//! Impacts of machines against independent results, and sequences of simultaneous impacts.

use std::f64::consts::PI;

use serde_json::Value;

use crate::collisions::{close, events, is_good, number, simulate};
use crate::support::{Scratch, json, lagrangian};

/// With sequential impacts and e = 1 three equal balls in a row leave with (0, 0, 1), and with e = ½ with (0.203125, 0.234375, 0.5625): by
/// hand, and in quadruple precision elsewhere.
#[test]
fn a_cradle_moves_ball_by_ball_where_the_order_says_so() {
    for (e, expected) in [
        ("1", [0.0, 0.0, 1.0]),
        ("0.5", [0.203125, 0.234375, 0.5625]),
    ] {
        let spec = Scratch::new(
            "cradle.machine",
            &format!(
                "machine Cradle in plane {{
                    parameters {{ m: kg = 0.1, r: m = 0.5, e: 1 = {e} }}
                    coordinates {{ a: m, b: m = 2, c: m = 3, der(a): m/s = 1 }}
                    bodies {{
                        first {{ mass: m, at: (a, 0) }}, second {{ mass: m, at: (b, 0) }}, third {{ mass: m, at: (c, 0) }},
                    }}
                    contacts {{
                        left  {{ gap: b - a - 2*r, restitution: e, order: sequence }},
                        right {{ gap: c - b - 2*r, restitution: e, order: sequence }},
                    }}
                }}"
            ),
        );
        let run = simulate(spec.path(), 1.5, &[]);
        is_good(&run);
        for (ball, expected) in ["a", "b", "c"].iter().zip(expected) {
            close(number(&run["v"][ball]), expected, 1e-14);
        }
        let lost = 0.05 * (1.0 - expected.iter().map(|v| v * v).sum::<f64>());
        close(number(&run["impact_loss"]), lost, 1e-15);
    }
}

/// A rod whose tip slips over rough ground in a pose for which Coulomb's law has no solution: an impact without a collision. Its impulse is
/// Routh's: p₁ until the slip of 5 m/s has stopped, and p₂ until the sticking tip no longer approaches the ground.
#[test]
fn a_jammed_rod_is_stopped_by_an_impact_without_a_collision() {
    let rod = |turns: f64| {
        Scratch::new(
            "rod.machine",
            &format!(
                "machine Rod in plane {{
                    parameters {{ g: m/s^2 = 9.81, mu: 1 = 3, tilt: rad = 1.2, l: m = 1, w: rad/s = {turns} }}
                    coordinates {{
                        x: m, y: m = l*sin(tilt), theta: rad = tilt,
                        der(x): m/s = -5, der(y): m/s = l*cos(tilt)*w, der(theta): rad/s = w,
                    }}
                    bodies {{ rod {{ mass: 1, inertia: 1/3, at: (x, y), angle: theta }} }}
                    gravity (0, -g);
                    contacts {{
                        tip {{
                            point: (-1, 0), on: rod, along: ground, restitution: 0, friction: mu, painleve: impact,
                        }}
                    }}
                }}"
            ),
        )
    };
    let run = simulate(rod(0.0).path(), 0.05, &[]);
    is_good(&run);
    let (sin, cos) = 1.2_f64.sin_cos();
    let (nn, nt, tt) = (
        1.0 + 3.0 * cos * cos,
        -3.0 * sin * cos,
        1.0 + 3.0 * sin * sin,
    );
    assert!(nn + 3.0 * nt < 0.0);
    let first = 5.0 / (nt + 3.0 * tt);
    let closes = -(nn + 3.0 * nt) * first;
    let second = closes / (nn - nt * nt / tt);
    let impact = events(&run, "impact")[0];
    close(number(&impact["impulse"][0]), first + second, 1e-13);
    close(
        number(&impact["impulse"][1]),
        3.0 * first - nt / tt * second,
        1e-13,
    );
    close(number(&impact["slip"][1]), 0.0, 1e-14);
    // For a mass of 1 kg impulses are the changes of the rates.
    let [x, y] = ["x", "y"].map(|name| number(&impact["v"][name]));
    close(x, -5.0 + 3.0 * first - nt / tt * second, 1e-13);
    close(y, first + second, 1e-13);
    close(number(&run["energy_residual"]), 0.0, 1e-11);
    // With a rotation that lifts the tip, the contact opens.
    let run = simulate(rod(4.0).path(), 0.01, &[]);
    is_good(&run);
    assert!(events(&run, "impact").is_empty(), "{run:#}");
    close(number(&run["v"]["x"]), -5.0, 1e-13);
}

/// A block that rests on rough ground is struck by a ball, level or from above, and slips: with n = (cos φ, −sin φ), the impulse P along n and
/// μ P sin φ from the ground, M V = P (cos φ − μ sin φ) and V cos φ + P/m − v = e v, until after V/(μ g) friction has stopped it.
#[test]
fn what_rests_with_friction_is_knocked_away() {
    let (m, mass, v, e, mu, g) = (1.0, 2.0, 2.0, 0.5, 0.3, 9.81);
    let [plane, space] = [
        "machine Struck in plane {
            parameters { m: kg = 1, M: kg = 2, phi: rad, v: m/s = 2, e: 1 = 0.5, mu: 1 = 0.3, g: m/s^2 = 9.81 }
            coordinates { X: m, Y: m, s: m, der(s): m/s = v }
            define { n = (cos(phi), -sin(phi)) }
            bodies { block { mass: M, at: (X, Y) }, ball { mass: m, at: s*n } }
            forces { held { at: block.at, force: (0, -M*g) } }
            contacts {
                floor { gap: Y, slip: der(X), restitution: 0, friction: mu },
                ball { gap: dot((X, Y), n) - s + 0.5, restitution: e },
            }
        }",
        "machine Struck in space {
            parameters { m: kg = 1, M: kg = 2, phi: rad, v: m/s = 2, e: 1 = 0.5, mu: 1 = 0.3, g: m/s^2 = 9.81 }
            coordinates { X: m, Z: m, Y: m, s: m, der(s): m/s = v }
            define { n = (cos(phi), 0, -sin(phi)) }
            frames { block = ground.shift(X, Z, Y) }
            bodies { block { mass: M, frame: block }, ball { mass: m, at: s*n } }
            forces { held { at: block.origin, force: (0, 0, -M*g) } }
            contacts {
                floor { point: (0, 0, 0), on: block, along: ground, restitution: 0, friction: mu },
                ball { gap: dot((X, Z, Y), n) - s + 0.5, restitution: e },
            }
        }",
    ];
    for (text, phi) in [(plane, 0.0), (plane, 0.4), (space, 0.0), (space, 0.4_f64)] {
        let spec = Scratch::new("struck.machine", text);
        let run = simulate(spec.path(), 0.4, &[&format!("phi={phi}")]);
        is_good(&run);
        let (sin, cos) = phi.sin_cos();
        let impulse = (1.0 + e) * v / ((cos - mu * sin) * cos / mass + 1.0 / m);
        let speed = impulse * (cos - mu * sin) / mass;
        let impact = events(&run, "impact")[0];
        close(number(&impact["t"]), 0.25, 1e-14);
        close(number(&impact["v"]["X"]), speed, 1e-13);
        close(number(&impact["v"]["s"]), v - impulse / m, 1e-13);
        let t = 0.15;
        assert!(t < speed / (mu * g));
        close(number(&run["v"]["X"]), speed - mu * g * t, 1e-12);
        close(
            number(&run["q"]["X"]),
            speed * t - mu * g * t * t / 2.0,
            1e-12,
        );
        // The ground does not move: its friction takes energy, and nothing gives any.
        close(number(&run["work"]), 0.0, 1e-12);
    }
}

/// In a circle all chords are equal: the ball meets the wall at equal intervals and angles, a hundred times in a row.
#[test]
fn a_billiard_ball_keeps_its_angle() {
    let run = simulate("machines/contacts/billiard.machine", 92.0, &[]);
    is_good(&run);
    let impacts = events(&run, "impact");
    let (radius, speed) = (0.9_f64, 2.0_f64);
    let (sin, cos) = 0.6_f64.sin_cos();
    // |(−0.5, 0) + s (cos, sin)| = 0.9.
    let reach = 0.5 * cos + (0.25 * cos * cos - 0.25 + radius * radius).sqrt();
    let incidence = (0.5 * sin / radius).asin();
    let chord = 2.0 * radius * incidence.cos();
    assert!(impacts.len() > 100);
    let first = (reach * sin).atan2(reach * cos - 0.5);
    for (k, impact) in impacts.iter().enumerate() {
        let t = (reach + k as f64 * chord) / speed;
        // Each impact rounds the direction, and all later ones inherit the error.
        let within = 1e-13 * (k + 10) as f64;
        close(number(&impact["t"]), t, within * 10.0);
        let angle = first - k as f64 * (std::f64::consts::PI - 2.0 * incidence);
        let [x, y] = ["x", "y"].map(|name| number(&impact["q"][name]));
        close(x, radius * angle.cos(), within * 10.0);
        close(y, radius * angle.sin(), within * 10.0);
    }
}

/// The slider's first contact in quadruple precision: two corners at once without rotation, and one with it.
#[test]
fn a_slider_with_play_meets_its_guide_when_it_should() {
    let slider = "machines/contacts/slider_crank_clearance.machine";
    let run = simulate(slider, 0.0035, &[]);
    assert_eq!(run["error"], Value::Null, "{run:#}");
    let impacts = events(&run, "impact");
    let t = number(&impacts[0]["t"]);
    close(t, 0.002_692_502_752_021_212, 1e-15);
    let first: Vec<&str> = (impacts.iter())
        .filter(|impact| number(&impact["t"]) == t)
        .filter_map(|impact| impact["contact"].as_str())
        .collect();
    assert_eq!(first, ["upper_left", "upper_right"]);
    close(
        number(&impacts[0]["q"]["theta1"]),
        0.355_304_455_027_745_3,
        1e-13,
    );
    close(
        number(&impacts[0]["q"]["theta2"]),
        -0.171_509_540_940_173_9,
        1e-13,
    );

    let run = simulate(slider, 0.0035, &["w3=-0.01"]);
    assert_eq!(run["error"], Value::Null, "{run:#}");
    let impact = events(&run, "impact")[0];
    assert_eq!(impact["contact"], "upper_left");
    close(number(&impact["t"]), 0.002_690_903_648_407_842, 1e-15);
}

/// Siconos's run of the woodpecker, by Moreau and Jean's scheme of first order in steps of 20 µs: after two beats, each with 4 impacts of
/// the beak and sleeve, its state agrees with ours within one percent. The beak pecks every 0.146 s.
#[test]
fn the_woodpecker_goes_down_its_pole_as_elsewhere() {
    let run = simulate("machines/contacts/woodpecker.machine", 0.2998, &[]);
    is_good(&run);
    let expected = [
        ("q", "y", -0.041_301_150_6),
        ("q", "phiS", -0.339_437_059_7),
        ("v", "y", -0.262_482_125_8),
        ("v", "phiS", -8.304_866_469),
    ];
    for (of, name, expected) in expected {
        close(number(&run[of][name]), expected, 0.01 * f64::abs(expected));
    }
    // The lower end of the sleeve touches the pole.
    close(number(&run["q"]["phiM"]), -0.0006 / 0.0058, 1e-12);
    let pecks: Vec<f64> = (events(&run, "impact").into_iter())
        .filter(|impact| impact["contact"] == "beak")
        .map(|impact| number(&impact["t"]))
        .collect();
    assert_eq!(pecks.len(), 2, "{run:#}");
    close(pecks[1] - pecks[0], 0.146, 0.001);
    close(number(&run["energy_residual"]), 0.0, 1e-12);
}

/// A block with `corners` rocks exactly as one with two points, bit by bit.
#[test]
fn corners_are_points() {
    let points = simulate("machines/contacts/rocking_block.machine", 1.2, &[]);
    let text =
        std::fs::read_to_string("../machines/contacts/rocking_block.machine").expect("the machine");
    let said = |outline: &str, corners: &str| {
        let feet = format!(
            "feet {{ corners: {corners}, on: block, along: ground, restitution: 0, friction: mu }} }} }}"
        );
        let text = text.replace("((-b, -h), (b, -h), (b, h), (-b, h))", outline);
        let from = text.find("left  {").expect("a contact");
        format!("{}{feet}", &text[..from])
    };
    let feet = "((-b, -h), (b, -h))";
    for spec in [said(feet, feet), said(feet, "outline")] {
        let spec = Scratch::new("corners.machine", &spec);
        let run = simulate(spec.path(), 1.2, &[]);
        is_good(&run);
        assert_eq!((&run["q"], &run["v"]), (&points["q"], &points["v"]));
        let [found, expected] = [&run, &points].map(|run| events(run, "impact").len());
        assert!(found == expected && found > 0);
        assert_eq!(events(&run, "impact")[0]["contact"], "feet[2]");
    }
}

/// Discs fall into a bowl. No contact force is tensile, there is no penetration, and the energy balance closes. (Eight of the machine's
/// twenty discs are used here, which take less time to derive.)
#[test]
fn discs_pile_up_in_a_bowl() {
    let pile = "machines/contacts/pile.machine";
    let output = lagrangian(&[
        "simulate", pile, "--const", "N=8", "--until", "0.5", "--json",
    ]);
    let run: Value = serde_json::from_slice(&output.stdout).expect("a document");
    is_good(&run);
    assert!(events(&run, "impact").len() > 20);
    for impact in events(&run, "impact") {
        // Discs have momenta of about 0.1 N s, whose rounding affects every impulse.
        let [normal, tangential] = [0, 1].map(|k| number(&impact["impulse"][k]));
        assert!(
            normal >= 0.0 && tangential.abs() <= 0.3 * normal * (1.0 + 1e-9) + 1e-15,
            "{impact}"
        );
    }
    let place = |name: &str, i: usize| number(&run["q"][format!("{name}[{i}]")]);
    for i in 1..=8 {
        let (x, y) = (place("x", i), place("y", i));
        assert!(x.hypot(y) <= 0.45 + 1e-9);
        for j in 1..i {
            assert!(
                (x - place("x", j)).hypot(y - place("y", j)) >= 0.1 - 1e-12,
                "{i} and {j}"
            );
        }
    }
    close(number(&run["energy_residual"]), 0.0, 1e-9);
}

/// The motion of an impact pair with two impacts in each period: between the walls the mass flies with v = 2 ω (d − A sin φ)/π, and Newton's
/// law requires A ω cos φ = v (1 − e)/(1 + e). Of the two phases that satisfy this, the later one is unstable, and a run leaves it; near the
/// other one errors decay, and every impact is at its closed-form time and place.
#[test]
fn an_impact_pair_keeps_its_period() {
    let (m, amplitude, w) = (1.0_f64, 0.01_f64, 10.0_f64);
    for (e, play) in [(0.7_f64, 2.0_f64), (0.5, 3.0), (0.3, 2.0)] {
        let d = play * amplitude;
        let share = (1.0 - e) / (1.0 + e);
        // Newton's method, started on the side of the stable phases.
        let mut phase = -1.2_f64;
        for _ in 0..50 {
            let k = 2.0 / PI * share;
            let f = phase.cos() - k * (play - phase.sin());
            phase -= f / (k * phase.cos() - phase.sin());
        }
        let v = 2.0 * w * (d - amplitude * phase.sin()) / PI;
        close(amplitude * w * phase.cos(), v * share, 1e-15);
        let settings = [
            format!("e={e:?}"),
            format!("d={d:?}"),
            format!("phase={phase:?}"),
        ];
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let run = simulate("machines/contacts/impact_pair.machine", 12.5, &settings);
        is_good(&run);
        let impacts = events(&run, "impact");
        assert_eq!(impacts.len(), (12.5 * w / PI).floor() as usize);
        let closing = 2.0 * v / (1.0 + e);
        for (k, impact) in impacts.iter().enumerate() {
            let wall = if k % 2 == 0 { "right" } else { "left" };
            assert_eq!(impact["contact"], wall);
            close(number(&impact["t"]), (k + 1) as f64 * PI / w, 1e-12);
            close(number(&impact["gap_rate"][0]), -closing, 1e-11 * closing);
            let loss = 0.5 * m * (1.0 - e * e) * closing * closing;
            close(number(&impact["loss"]), loss, 1e-11 * loss);
        }
        // The impacts dissipate the work of the carriage.
        close(number(&run["work"]), number(&run["impact_loss"]), 1e-12);
    }
}

/// A ball that is thrown slips in two impacts; in the second one its slip stops, but for rounding, and in those that follow it sticks.
/// The derivatives are those of the closed form.
#[test]
fn derivatives_go_on_after_an_impact_has_stopped_a_slip() {
    let spec = "machine Thrown in plane {
        parameters { m: kg = 0.05, h: m = 1, e: 1 = 0.8, mu: 1 = 0.1, g: m/s^2 = 9.81 }
        coordinates { y: m = h, x: m, der(x): m/s = 1 }
        bodies { ball { mass: m, at: (x, y) } }
        gravity (0, -g);
        contacts { floor { gap: y, slip: der(x), restitution: e, friction: mu } }
    }";
    let end = |[h, e, g]: [f64; 3]| {
        let (mut t, mut speed) = ((2.0 * h / g).sqrt(), (2.0 * g * h).sqrt());
        let (mut slip, mut x) = (1.0, t);
        loop {
            slip = f64::max(0.0, slip - 0.1 * (1.0 + e) * speed);
            speed *= e;
            let flight = 2.0 * speed / g;
            let rest = 2.0 - t;
            if flight > rest {
                return [speed * rest - g * rest * rest / 2.0, x + slip * rest];
            }
            (t, x) = (t + flight, x + slip * flight);
        }
    };
    let spec = Scratch::new("thrown.machine", spec);
    let by = ["--by", "h,e,g", "--of", "y,x", "--tolerance", "1e-12"];
    let call = ["sensitivities", spec.path(), "--until", "2", "--json"];
    let found = json(&[&call[..], &by].concat());
    let derivatives = found["derivatives"].as_array().expect("a list");
    for (j, name) in ["h", "e", "g"].into_iter().enumerate() {
        // Central differences of the closed form: h² of the third derivative, and the round-off divided by h.
        let moved = |by: f64| {
            let mut at = [1.0, 0.8, 9.81];
            at[j] += by;
            end(at)
        };
        let (above, below) = (moved(1e-5), moved(-1e-5));
        for (i, of) in ["y", "x"].into_iter().enumerate() {
            let expected = (above[i] - below[i]) / 2e-5;
            let name = format!("{of} by {name}");
            let one = derivatives.iter().find(|one| one["name"] == *name);
            let values = one.expect("a derivative")["values"].as_array();
            let value = number(values.and_then(|all| all.last()).expect("a value"));
            assert!(
                (value - expected).abs() < 1e-7,
                "{name}: {value}, not {expected}"
            );
        }
    }
}

/// Bodies that bounce on each other in sequence come to rest on each other, wherever their coordinates are measured from and in whatever order they are listed.
/// Flights that are lower than the round-off of a gap, 64 of which are followed at most, take `2 √(2 h/g)` each, and a geometric series of them is at most 1/(1 − e)
/// times as long: 1e-6 s for gaps between places of 0.6 m. All energy is lost.
#[test]
fn stacks_that_bounce_in_sequence_come_to_rest_in_every_spelling() {
    // Masses, heights above each other's rest, and coefficients of restitution.
    type Stack<'a> = (&'a [f64], &'a [f64], &'a [f64]);
    let stacks: [Stack; 4] = [
        (
            &[2.3544674731518236, 2.487983913914242, 2.856125709442626],
            &[0.0, 0.0, 0.05],
            &[0.8456274976657918, 0.22030365979853034, 0.5259358580646738],
        ),
        (
            &[1.981602276567914, 0.8260569902128568],
            &[0.18167985904179806, 0.05],
            &[0.5318374755829887, 0.6065964590450391],
        ),
        (
            &[
                2.6643557131248037,
                2.6421575159618738,
                2.4530451384494096,
                1.6295808014989133,
            ],
            &[0.05585210567889389, 0.0, 0.0, 0.17863095175220086],
            &[
                0.33293142191516034,
                0.762730218904734,
                0.5330342653462135,
                0.629771183841555,
            ],
        ),
        (
            &[2.876941470450222, 0.7833897323039412],
            &[0.14404891281348012, 0.08719907947928801],
            &[0.6512244359738698, 0.6512244359738698],
        ),
    ];
    for (masses, drops, restitution) in stacks {
        let n = masses.len();
        let heights: Vec<f64> = (0..n)
            .map(|i| drops[..=i].iter().sum::<f64>() + 0.1 * i as f64)
            .collect();
        let energy: f64 = (0..n)
            .map(|i| masses[i] * 9.81 * (heights[i] - 0.1 * i as f64))
            .sum();
        let mut rests = Vec::new();
        for (relative, reversed) in [(false, false), (false, true), (true, false), (true, true)] {
            let mut order: Vec<usize> = (0..n).collect();
            if reversed {
                order.reverse();
            }
            let place = |i: usize| {
                if !relative {
                    return format!("y{i}");
                }
                let terms: Vec<String> = (0..=i).map(|j| format!("y{j}")).collect();
                terms.join(" + 0.1 + ")
            };
            let list = |of: &dyn Fn(usize) -> String| {
                let all: Vec<String> = order.iter().map(|i| of(*i)).collect();
                all.join(", ")
            };
            let start = |i: usize| if relative { drops[i] } else { heights[i] };
            let coordinates = list(&|i| format!("y{i}: m = {:?}", start(i)));
            let bodies =
                list(&|i| format!("b{i} {{ mass: {:?}, at: (0, {}) }}", masses[i], place(i)));
            let contacts = list(&|i| {
                let gap = match i {
                    0 => place(0),
                    _ => format!("{} - ({}) - 0.1", place(i), place(i - 1)),
                };
                format!(
                    "c{i} {{ gap: {gap}, restitution: {:?}, order: sequence }}",
                    restitution[i]
                )
            });
            let spec = Scratch::new(
                "stack.machine",
                &format!(
                    "machine Stack in plane {{
                        coordinates {{ {coordinates} }}
                        bodies {{ {bodies} }}
                        gravity (0, -9.81);
                        contacts {{ {contacts} }}
                    }}"
                ),
            );
            let run = json(&[
                "simulate",
                spec.path(),
                "--until",
                "2",
                "--max-steps",
                "2000",
                "--json",
            ]);
            is_good(&run);
            close(number(&run["dissipated"]), energy, 1e-9 * energy);
            for (i, contact) in order
                .iter()
                .zip(run["unilateral_contacts"].as_array().expect("contacts"))
            {
                assert_eq!(contact["name"], format!("c{i}"));
                rests.push(number(&contact["closed_at"]));
            }
        }
        let spread = rests
            .iter()
            .fold(0.0_f64, |most, t| most.max((t - rests[0]).abs()));
        assert!(spread <= 4e-6, "{rests:?}");
    }
}
