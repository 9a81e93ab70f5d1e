//! Contacts of convex polygons, against closed forms, against the same contacts written corner by corner, and against a test of
//! overlap that shares nothing with the compiler.

use serde_json::Value;

use crate::collisions::{close, events, is_good, number, simulate};
use crate::support::{Scratch, json, lagrangian};

const BOXES: &str = "machines/contacts/box_on_box.machine";
const G: f64 = 9.81;

/// A run and the table that it writes: its columns and its rows.
struct Table {
    run: Value,
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Table {
    fn column(&self, name: &str) -> usize {
        let found = self.names.iter().position(|known| known == name);
        found.unwrap_or_else(|| panic!("no {name} in {:?}", self.names))
    }
}

fn table(spec: &str, until: &str, every: &str, settings: &[&str]) -> Table {
    let table = Scratch::new("polygons.csv", "");
    let mut call = vec![
        "simulate", spec, "--until", until, "--every", every, "--json",
    ];
    call.extend(["--tolerance", "1e-12", "--out", table.path()]);
    for setting in settings {
        call.extend(["--set", setting]);
    }
    let output = lagrangian(&call);
    let run: Value = serde_json::from_slice(&output.stdout).expect("a document");
    assert_eq!(run["error"], Value::Null, "{run:#}");
    let text = std::fs::read_to_string(table.path()).expect("a table");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names = lines.next().expect("names").split(',');
    // Strips the units.
    let names = names.map(|name| name.split(" [").next().unwrap_or_default().to_owned());
    let names = names.collect();
    let numbers = |line: &str| {
        line.split(',')
            .map(|x| x.parse().expect("a number"))
            .collect()
    };
    let rows = lines.map(numbers).collect();
    Table { run, names, rows }
}

/// A box on the slope of a polygon stays in place up to tan α = μ, and beyond that slides down with g (sin α − μ cos α).
#[test]
fn a_box_slides_down_a_polygon_beyond_its_angle_of_friction() {
    let spec = Scratch::new(
        "slope.machine",
        "machine Slope in plane {
            parameters { alpha: rad = 0.3, mu: 1 = 0.4, m: kg = 2, b: m = 0.1, h: m = 0.05, g: m/s^2 = 9.81 }
            coordinates {
                x: m = -h*sin(alpha), y: m = h*cos(alpha), theta: rad = alpha,
            }
            frames { slope = ground.turn(alpha), held = ground.shift(x, y).turn(theta) }
            bodies { box { mass: m, inertia: m*(b^2 + h^2)/3, frame: held, outline: ((b, h), (-b, h), (-b, -h), (b, -h)) } }
            gravity (0, -g);
            contacts {
                lies {
                    corners: outline, on: box, against: ((-9, -1), (9, -1), (9, 0), (-9, 0)), of: slope,
                    restitution: 0, friction: mu,
                },
            }
        }",
    );
    let critical = 0.4_f64.atan();
    for alpha in [0.3, critical - 1e-9, critical + 1e-3, 0.5] {
        let run = simulate(spec.path(), 0.5, &[&format!("alpha={alpha:?}")]);
        is_good(&run);
        let (sin, cos) = alpha.sin_cos();
        let a = if alpha > critical {
            G * (sin - 0.4 * cos)
        } else {
            0.0
        };
        let way = -0.5 * a * 0.25;
        close(number(&run["q"]["x"]), way * cos - 0.05 * sin, 1e-13);
        close(number(&run["q"]["y"]), way * sin + 0.05 * cos, 1e-13);
        close(number(&run["q"]["theta"]), alpha, 1e-14);
        close(
            number(&run["dissipated"]),
            2.0 * G * 0.4 * cos * -way,
            1e-12,
        );
        assert!(events(&run, "impact").is_empty(), "{run:#}");
    }
}

/// On a lower box that slides freely, friction brings both boxes to the same velocity after v/(μ g (1 + m/M)), and dissipates the
/// energy that they lose.
#[test]
fn a_box_is_braked_on_another() {
    let (m, mu) = (1.0, 0.3);
    for big in [4.0, 10.0] {
        let share = m / big;
        let run = simulate(BOXES, 0.8, &[&format!("M={big:?}")]);
        is_good(&run);
        let brakes = mu * G * (1.0 + share);
        let sticks = events(&run, "sticks");
        // Both corners in contact begin to stick at once.
        let mut of_stack = sticks.iter().filter(|event| {
            let contact = event["contact"].as_str();
            contact.is_some_and(|contact| contact.starts_with("stack"))
        });
        for k in [1, 4] {
            let event = of_stack.next().expect("it sticks");
            assert_eq!(event["contact"], format!("stack[{k}]"));
            close(number(&event["t"]), 1.0 / brakes, 1e-11);
        }
        let together = share / (1.0 + share);
        close(number(&run["v"]["x"]), together, 1e-12);
        close(number(&run["v"]["X"]), together, 1e-12);
        let apart = number(&run["q"]["x"]) - number(&run["q"]["X"]);
        close(apart, 0.5 / brakes, 1e-12);
        close(number(&run["dissipated"]), 0.5 * m / (1.0 + share), 1e-12);
        close(number(&run["q"]["theta"]), 0.0, 1e-13);
        assert!(events(&run, "impact").is_empty());
    }
}

/// On a rough floor everything is at rest after v/(μ g), although the load is shared by four corners in an undetermined way; both as
/// polygons and as corners along a line of the lower box.
#[test]
fn boxes_that_share_a_load_come_to_rest() {
    let text = std::fs::read_to_string("../machines/contacts/box_on_box.machine").expect("a spec");
    let lines = text
        .replace("over = ground", "top = under.shift(0, H), over = ground")
        .replace("against: outline, of: lower", "along: top");
    let lines = Scratch::new("lines.machine", &lines);
    for spec in [BOXES, lines.path()] {
        for floor in ["mu_floor=0.4", "mu_floor=0.5"] {
            let run = simulate(spec, 0.8, &[floor]);
            is_good(&run);
            let stops = 1.0 / (0.3 * G);
            for event in events(&run, "sticks") {
                close(number(&event["t"]), stops, 1e-11);
            }
            assert!(events(&run, "reverses").is_empty());
            close(number(&run["q"]["x"]), 0.5 * stops, 1e-12);
            close(number(&run["v"]["x"]), 0.0, 1e-14);
            close(number(&run["friction_loss"]), 0.5, 1e-12);
        }
    }
}

/// A box that overhangs the end of another rests on one corner of its own and on one of the other, which share the load by the law of
/// the lever; for aligned boxes the distribution is undetermined, and they stay in place.
#[test]
fn a_box_lies_on_the_ends_of_what_both_have_in_common() {
    for start in [0.32_f64, 0.36, -0.36] {
        let told = table(
            BOXES,
            "0.1",
            "0.05",
            &["speed=0", &format!("start={start:?}")],
        );
        is_good(&told.run);
        let last = told.rows.last().expect("rows");
        let of = |name: &str| last[told.column(name)];
        let normal = |k: usize| of(&format!("normal(stack[{k}])"));
        // The upper box has the corners 1 and 4 at its bottom, the lower one 6 and 7 at its top: right and left.
        let (own, end) = if start > 0.0 { (4, 6) } else { (1, 7) };
        let lever = (0.4 - start.abs()) / (0.5 - start.abs());
        close(normal(own), G * lever, 1e-11);
        close(normal(end), G * (1.0 - lever), 1e-11);
        for k in (1..=8).filter(|k| *k != own && *k != end) {
            assert_eq!(normal(k), 0.0, "{k}");
            assert!(of(&format!("gap(stack[{k}])")) > 0.01, "{k}");
        }
        close(of("x"), start, 1e-15);
        close(of("theta"), 0.0, 1e-15);
    }
    let run = simulate(BOXES, 0.5, &["speed=0", "b=0.4"]);
    is_good(&run);
    close(number(&run["q"]["x"]), 0.0, 1e-13);
    close(number(&run["q"]["theta"]), 0.0, 1e-13);
}

/// On a platform that moves uniformly everything is as on one at rest, in coordinates relative to the platform: a box that overhangs
/// its end rests, with the load shared by the law of the lever, or slides until it rests after v²/(2 μ g). The velocities by explicit
/// time cancel in the slips, so that one contact sees a rate of some 1e-300 m/s that the other one loses by rounding.
#[test]
fn a_box_rests_over_the_end_of_a_platform_that_moves_uniformly() {
    let spec = Scratch::new(
        "carried.machine",
        "machine Carried in plane {
            parameters { m: kg = 1.5, J: kg*m^2 = 0.005, speed: m/s, rise: m/s, mu: 1 = 0.2, g: m/s^2 = 9.81, from: m, v0: m/s }
            coordinates { x: m = from, y: m = 0.05, theta: rad, der(x): m/s = v0 }
            frames { platform = ground.shift(speed*t, rise*t), held = platform.shift(x, y).turn(theta) }
            bodies { box { mass: m, inertia: J, frame: held } }
            gravity (0, -g);
            contacts {
                lies {
                    corners: ((-0.1, -0.05), (0.1, -0.05), (0.1, 0.05), (-0.1, 0.05)), on: box,
                    against: ((0, -0.2), (2, -0.2), (2, 0), (0, 0)), of: platform, restitution: 0, friction: mu,
                },
            }
        }",
    );
    let at = |speed: f64, rise: f64, from: f64, v0: f64| {
        let settings = [
            format!("speed={speed:?}"),
            format!("rise={rise:?}"),
            format!("from={from:?}"),
            format!("v0={v0:?}"),
        ];
        let all: Vec<&str> = settings.iter().map(String::as_str).collect();
        table(spec.path(), "1", "0.5", &all)
    };
    for (speed, rise) in [(1.3, 0.0), (-1e-9, 0.0), (7.0, -0.3)] {
        for (from, own, end) in [(0.03, 2, 8), (1.96, 1, 7)] {
            let told = at(speed, rise, from, 0.0);
            is_good(&told.run);
            let last = told.rows.last().expect("rows");
            let of = |name: &str| last[told.column(name)];
            close(of("x"), from, 1e-13);
            close(of("theta"), 0.0, 1e-13);
            // The corner of the platform is this far from the centre of the box, and that of the box 0.1 m on the other side.
            let arm = from.min(2.0 - from);
            let share = arm / (arm + 0.1);
            close(of(&format!("normal(lies[{own}])")), 1.5 * G * share, 1e-9);
            close(
                of(&format!("normal(lies[{end}])")),
                1.5 * G * (1.0 - share),
                1e-9,
            );
        }
        let told = at(speed, rise, 0.01, 0.5);
        is_good(&told.run);
        let last = told.rows.last().expect("rows");
        close(last[told.column("x")], 0.01 + 0.25 / (0.4 * G), 1e-11);
        close(last[told.column("der(x)")], 0.0, 1e-13);
    }
}

/// When a box slides over the end of another, contact passes from its corner to that of the other box without an impact. x = v t − ½
/// μ g t² until its centre, corrected by the shift of the load due to friction, is over the end; then it tips about that.
#[test]
fn a_box_slides_over_the_end_of_another_without_an_impact() {
    let (mu, v) = (0.1, 3.0_f64);
    let run = simulate(BOXES, 0.33, &["speed=3", "mu=0.1", "mu_floor=0.9"]);
    is_good(&run);
    let time_at = |x: f64| (v - (v * v - 2.0 * mu * G * x).sqrt()) / (mu * G);
    let of = |kind: &str, contact: &str| -> Vec<f64> {
        let own = events(&run, kind).into_iter();
        let own = own.filter(|event| event["contact"] == contact);
        own.map(|event| number(&event["t"])).collect()
    };
    // Its front corner leaves the face when that of the other box comes under it.
    let passes = time_at(0.3);
    close(of("lifts", "stack[1]")[0], passes, 1e-11);
    close(of("closes", "stack[6]")[0], passes, 1e-11);
    // Friction shifts the load ahead of the centre by μ h.
    let tips = time_at(0.4 - mu * 0.05);
    close(of("lifts", "stack[4]")[0], tips, 1e-10);
    let first = events(&run, "impact")
        .first()
        .map_or(f64::INFINITY, |event| number(&event["t"]));
    assert!(first > tips + 1e-3, "{first}");
    // It falls beside the other box, turning to the right.
    assert!(
        number(&run["q"]["theta"]) < -0.1
            && number(&run["q"]["x"]) > 0.5
            && number(&run["q"]["y"]) < 0.2,
        "{run:#}"
    );
}

/// A box that falls flat touches with two corners at once, and bounces as a ball does: it is at rest after √(2 d/g) (1 + e)/(1 − e).
#[test]
fn a_box_lands_flat_on_another_with_two_corners_at_once() {
    for (drop, e) in [(0.2_f64, 0.5_f64), (0.05, 0.0), (0.3, 0.7)] {
        let falls = (2.0 * drop / G).sqrt();
        let settings = [format!("drop={drop:?}"), format!("e={e:?}")];
        let mut all: Vec<&str> = settings.iter().map(String::as_str).collect();
        all.push("speed=0");
        let rests = falls * (1.0 + e) / (1.0 - e);
        let run = simulate(BOXES, rests + 0.1, &all);
        is_good(&run);
        let impacts = events(&run, "impact");
        let stack: Vec<_> = impacts
            .iter()
            .filter(|event| {
                event["contact"]
                    .as_str()
                    .is_some_and(|c| c.starts_with("stack"))
            })
            .collect();
        for (impact, k) in stack.iter().zip([1, 4]) {
            assert_eq!(impact["contact"], format!("stack[{k}]"));
            close(number(&impact["t"]), falls, 1e-14);
            close(number(&impact["gap_rate"][1]), e * G * falls, 1e-12);
            // Each corner carries half of it.
            close(
                number(&impact["impulse"][0]),
                0.5 * (1.0 + e) * G * falls,
                1e-12,
            );
        }
        let closes = events(&run, "closes");
        let own = closes
            .iter()
            .find(|event| event["contact"] == "stack[1]")
            .expect("it closes");
        close(number(&own["t"]), rests, 1e-8);
        close(number(&run["q"]["y"]), 0.25, 1e-12);
        close(number(&run["q"]["theta"]), 0.0, 1e-12);
        close(number(&run["impact_loss"]), G * drop, 1e-10);
        close(number(&run["energy_residual"]), 0.0, 1e-11);
    }
}

/// Contacts written as corners along a line, or as edges of a stair, move as polygons do: a box that falls on a floor, and one that
/// tumbles down a step.
#[test]
fn polygons_move_as_what_is_written_corner_by_corner() {
    let stair =
        std::fs::read_to_string("../machines/contacts/box_on_stair.machine").expect("the machine");
    let begins = stair.find("    contacts {").expect("contacts");
    let head = stair[..begins].replace("N = 3", "N = 1");
    let polygons = Scratch::new(
        "step.machine",
        &format!(
            "{head}
            contacts {{
                floor {{ corners: outline, on: box, along: ground, restitution: e, friction: mu }},
                step {{
                    corners: outline, on: box, against: ((-9, 0), (0, 0), (0, rise), (-9, rise)), of: ground,
                    restitution: e, friction: mu,
                }},
            }}
        }}"
        ),
    );
    let lines = Scratch::new("lines.machine", &stair.replace("N = 3", "N = 1"));
    let by = |spec: &str, settings: &[&str]| simulate(spec, 1.0, settings);
    for settings in [
        &["start=-0.03", "speed=0", "tilt=-0.3"],
        &["start=0.02", "speed=0.8", "tilt=-0.2"],
        &["start=0.06", "speed=0.5", "tilt=-0.4"],
    ] {
        let [found, expected] = [polygons.path(), lines.path()].map(|spec| by(spec, settings));
        is_good(&found);
        for name in ["x", "y", "theta"] {
            // A sequence of impacts, each of which multiplies errors by about ten.
            close(
                number(&found["q"][name]),
                number(&expected["q"][name]),
                1e-9,
            );
            close(
                number(&found["v"][name]),
                number(&expected["v"][name]),
                1e-8,
            );
        }
        let count = |run: &Value| events(run, "impact").len();
        assert_eq!(count(&found), count(&expected), "{settings:?}");
        assert!(count(&found) > 10);
    }
    let floor = |contacts: &str| {
        let spec = format!(
            "machine Falls in plane {{
                coordinates {{ x: m, y: m = 1, theta: rad = 0.4, der(x): m/s = 0.7, der(theta): rad/s = -2 }}
                frames {{ held = ground.shift(x, y).turn(theta) }}
                bodies {{ box {{ mass: 2, inertia: 0.03, frame: held, outline: ((0.2, 0.1), (-0.1, 0.15), (-0.2, -0.1), (0.15, -0.1)) }} }}
                gravity (0, -9.81);
                contacts {{ floor {{ corners: outline, on: box, {contacts}, restitution: 0.4, friction: 0.3 }} }}
            }}"
        );
        Scratch::new("falls.machine", &spec)
    };
    let line = floor("along: ground");
    let plate = floor("against: ((-50, -3), (50, -3), (50, 0), (-50, 0)), of: ground");
    let [line, plate] = [line.path(), plate.path()].map(|spec| simulate(spec, 1.2, &[]));
    is_good(&plate);
    assert!(events(&line, "impact").len() > 3);
    assert_eq!(
        events(&plate, "impact").len(),
        events(&line, "impact").len()
    );
    for name in ["x", "y", "theta"] {
        close(number(&plate["q"][name]), number(&line["q"][name]), 1e-10);
    }
}

/// Corners of a convex polygon: on an ellipse, counterclockwise.
fn polygon(random: &mut impl FnMut() -> f64) -> Vec<[f64; 2]> {
    let count = 3 + (random() * 3.0) as usize;
    // Some are as thin as needles.
    let thin = if random() < 0.4 {
        0.01
    } else {
        0.4 + 0.6 * random()
    };
    let turn = 6.0 * random();
    (0..count)
        .map(|k| {
            let angle = (k as f64 + 0.5 * random()) * std::f64::consts::TAU / count as f64;
            let [x, y] = [angle.cos(), thin * angle.sin()];
            [
                turn.cos() * x - turn.sin() * y,
                turn.sin() * x + turn.cos() * y,
            ]
            .map(|x| 0.3 * x)
        })
        .collect()
}

/// The penetration depth of polygons: the smallest displacement along the normal of any edge that separates them; negative if they
/// do not overlap.
fn overlap(polygons: [&[[f64; 2]]; 2]) -> f64 {
    let mut least = f64::INFINITY;
    for polygon in polygons {
        for (k, a) in polygon.iter().enumerate() {
            let b = polygon[(k + 1) % polygon.len()];
            let [x, y] = [b[1] - a[1], a[0] - b[0]];
            let length = x.hypot(y);
            let range = |polygon: &[[f64; 2]]| {
                let along = polygon.iter().map(|p| (p[0] * x + p[1] * y) / length);
                along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], s| {
                    [low.min(s), high.max(s)]
                })
            };
            let [one, other] = polygons.map(range);
            least = least.min(one[1].min(other[1]) - one[0].max(other[0]));
        }
    }
    least
}

/// The tip of a triangle dips into a needle by 0.3 mm and leaves it on the same side, while other corners fall below zero later in the step. A spring between
/// the centres leaves both to turn uniformly and their centres to oscillate about each other with ω² = 9/2 s⁻²; the tip reaches the needle at the first zero of the
/// greatest of its distances from the needle's three lines, in 53 bits.
#[test]
fn the_first_of_several_falls_in_a_step_is_found() {
    let spec = Scratch::new(
        "thrown.machine",
        "machine Thrown in plane {
         coordinates { x: m = -1, y: m = 0.10970265936426771, a: rad = 2.0324208183343817, X: m = 1, Y: m, A: rad, der(x): m/s = 2, der(a): rad/s = -8.240913680361134, der(A): rad/s = 2.7098944244458423, }
         frames { one = ground.shift(x, y).turn(a), two = ground.shift(X, Y).turn(A) }
         bodies {
          one { mass: 1, inertia: 0.02, frame: one, outline: ((-0.1585473716233326, 0.2540917859392168), (0.11126599276809389, -0.1825273836426701), (-0.06009168353498481, 0.1016432534485761)) },
          two { mass: 2, inertia: 0.05, frame: two, outline: ((-0.28510114107549867, 0.07012915312204879), (0.14461775715493963, -0.20922019275367076), (0.011497526277954178, 0.19923043575615831)) },
         }
         springs { pull { stiffness: 3, from: one.at, to: two.at } }
         contacts { hit { corners: outline, on: one, against: outline, of: two, restitution: 1.0, friction: 0.0 } }
        }",
    );
    let run = simulate(spec.path(), 3.0, &[]);
    is_good(&run);
    let impacts = events(&run, "impact");
    assert_eq!(impacts[0]["contact"], "hit[6]");
    close(number(&impacts[0]["t"]), 0.48367506646294106, 1e-9);
    close(number(&run["dissipated"]), 0.0, 1e-9);
}

/// Random polygons, some as thin as needles, that a spring pulls against each other again and again: they never overlap, elastic ones
/// conserve their energy, and momenta are conserved in all contacts.
#[test]
fn polygons_never_overlap_and_keep_their_momenta() {
    let seed: u64 = std::env::var("SEED")
        .ok()
        .and_then(|s| s.parse().ok())
        .unwrap_or(20_261_127);
    println!("SEED={seed}");
    let mut state = seed;
    let mut random = move || {
        // Xorshift* of G. Marsaglia and S. Vigna.
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1_u64 << 53) as f64
    };
    // Half of the polygons miss each other for most of their time: there are as many scenes as it takes to see enough impacts.
    let mut impacts = 0;
    let mut round = 0;
    while round < 10 || impacts <= 30 {
        assert!(round < 100, "{impacts} impacts in {round} scenes");
        round += 1;
        let shapes = [polygon(&mut random), polygon(&mut random)];
        let corners = |shape: &[[f64; 2]]| {
            let all: Vec<String> = shape
                .iter()
                .map(|[x, y]| format!("({x:?}, {y:?})"))
                .collect();
            format!("({})", all.join(", "))
        };
        let (e, mu) = if round % 2 == 1 {
            (1.0, 0.0)
        } else {
            (0.6, 0.5)
        };
        let [spin, turn, past] = [0, 1, 2].map(|_| 2.0 * random() - 1.0);
        let spec = format!(
            "machine Thrown in plane {{
                coordinates {{
                    x: m = -1, y: m = {:?}, a: rad = {:?}, X: m = 1, Y: m, A: rad,
                    der(x): m/s = 2, der(a): rad/s = {:?}, der(A): rad/s = {:?},
                }}
                frames {{ one = ground.shift(x, y).turn(a), two = ground.shift(X, Y).turn(A) }}
                bodies {{
                    one {{ mass: 1, inertia: 0.02, frame: one, outline: {} }},
                    two {{ mass: 2, inertia: 0.05, frame: two, outline: {} }},
                }}
                springs {{ pull {{ stiffness: 3, from: one.at, to: two.at }} }}
                contacts {{ hit {{ corners: outline, on: one, against: outline, of: two, restitution: {e:?}, friction: {mu:?} }} }}
            }}",
            0.3 * past,
            3.0 * turn,
            9.0 * spin,
            4.0 * turn,
            corners(&shapes[0]),
            corners(&shapes[1]),
        );
        let spec = Scratch::new("thrown.machine", &spec);
        let told = table(spec.path(), "3", "0.002", &[]);
        close(number(&told.run["energy_residual"]), 0.0, 1e-9);
        impacts += events(&told.run, "impact").len();
        if e == 1.0 {
            close(number(&told.run["dissipated"]), 0.0, 1e-9);
        }
        let Table { rows, .. } = &told;
        let column = |name: &str| told.column(name);
        let [x, y, a] = ["x", "y", "a"].map(column);
        let [xx, yy, aa] = ["X", "Y", "A"].map(column);
        let rate = |name: &str| column(&format!("der({name})"));
        let momenta = |row: &[f64]| {
            let [vx, vy, w] = ["x", "y", "a"].map(|name| row[rate(name)]);
            let [ux, uy, o] = ["X", "Y", "A"].map(|name| row[rate(name)]);
            let own = row[x] * vy - row[y] * vx + 0.02 * w;
            let other = 2.0 * (row[xx] * uy - row[yy] * ux) + 0.05 * o;
            [vx + 2.0 * ux, vy + 2.0 * uy, own + other]
        };
        let begins = momenta(&rows[0]);
        for row in rows {
            let placed = |shape: &[[f64; 2]], [x, y, a]: [usize; 3]| -> Vec<[f64; 2]> {
                let (sin, cos) = row[a].sin_cos();
                let place = |p: &[f64; 2]| {
                    [
                        row[x] + cos * p[0] - sin * p[1],
                        row[y] + sin * p[0] + cos * p[1],
                    ]
                };
                shape.iter().map(place).collect()
            };
            let [one, two] = [
                placed(&shapes[0], [x, y, a]),
                placed(&shapes[1], [xx, yy, aa]),
            ];
            let deep = overlap([&one, &two]);
            // The tolerance of the run, and the error of dense output.
            assert!(deep < 1e-9, "round {round}: {deep:e} at {row:?}");
            for (now, then) in momenta(row).iter().zip(begins) {
                close(*now, then, 1e-8);
            }
        }
    }
}

/// A corner that turns by more than a radian in a step may come and go between few samples: the impacts must be the same as
/// in short steps.
#[test]
fn corners_of_what_turns_fast_are_seen() {
    let spec = Scratch::new(
        "needles.machine",
        "machine Needles in plane {
            coordinates {
                x: m = -1, y: m = -0.043483395326655634, a: rad = -2.325164558289584, X: m = 1, Y: m, A: rad,
                der(x): m/s = 2, der(a): rad/s = 3.924295962352905, der(A): rad/s = -3.1002194110527785,
            }
            frames { one = ground.shift(x, y).turn(a), two = ground.shift(X, Y).turn(A) }
            bodies {
                one {
                    mass: 1, inertia: 0.02, frame: one,
                    outline: ((-0.2854980929963377, 0.018691828204576724), (0.07620873244274891, -0.008138307286298935),
                        (0.28808226656264013, -0.01895628168271136), (-0.19494926400313511, 0.01566143591270012)),
                },
                two {
                    mass: 2, inertia: 0.05, frame: two,
                    outline: ((0.16051778121385976, 0.22901086263269269), (-0.12800095569914705, -0.17756409864679568),
                        (-0.03503481979805981, -0.05464872848916714)),
                },
            }
            springs { pull { stiffness: 3, from: one.at, to: two.at } }
            contacts { hit { corners: outline, on: one, against: outline, of: two, restitution: 1, friction: 0 } }
        }",
    );
    let run = |longest: &str| -> Value {
        let call = [
            "simulate",
            spec.path(),
            "--until",
            "3",
            "--tolerance",
            "1e-12",
            "--longest-step",
            longest,
            "--json",
        ];
        serde_json::from_slice(&lagrangian(&call).stdout).expect("a document")
    };
    let [free, short] = ["1", "0.002"].map(run);
    let [found, expected] = [&free, &short].map(|run| events(run, "impact"));
    assert_eq!(found.len(), expected.len());
    for (one, other) in found.iter().zip(&expected) {
        assert_eq!(one["contact"], other["contact"]);
        close(number(&one["t"]), number(&other["t"]), 1e-9);
    }
}

/// With time stepping a box stops at the right place to first order in the step, and does not penetrate the other.
#[test]
fn boxes_are_stepped_too() {
    for h in [1e-3, 2.5e-4] {
        let step = format!("{h:e}");
        let call = [
            "simulate",
            BOXES,
            "--until",
            "0.6",
            "--json",
            "--method",
            "moreau",
            "--longest-step",
            &step,
        ];
        let run: Value = serde_json::from_slice(&lagrangian(&call).stdout).expect("a document");
        assert_eq!(run["error"], Value::Null, "{run:#}");
        let apart = number(&run["q"]["x"]) - number(&run["q"]["X"]);
        close(apart, 0.5 / (0.3 * G * 1.25), 2.0 * h);
        close(number(&run["q"]["y"]), 0.25, 1e-12);
    }
}

/// At the transition of a corner over the end of a face the derivative of the motion is not known, so it is refused by name.
#[test]
fn derivatives_across_polygons_are_refused() {
    let call = [
        "sensitivities",
        BOXES,
        "--by",
        "mu",
        "--of",
        "x",
        "--until",
        "0.1",
    ];
    let output = lagrangian(&call);
    assert!(!output.status.success());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        said.contains("`stack[1]`") && said.contains("two polygons"),
        "{said}"
    );
}

/// A box that falls on a plate from next to nothing, one corner after the other: the same bounces as on a line, until they end.
#[test]
fn corners_that_bounce_one_after_the_other_come_to_rest() {
    let floor = |contacts: &str| {
        let spec = format!(
            "machine Falls in plane {{
                parameters {{ drop: m = 0, e: 1 = 0 }}
                coordinates {{ x: m = 0.3, y: m = 0.1 + drop, theta: rad }}
                frames {{ held = ground.shift(x, y).turn(theta) }}
                bodies {{ box {{ mass: 2, inertia: 0.04, frame: held, outline: ((-0.2, -0.1), (0.2, -0.1), (0.2, 0.1), (-0.2, 0.1)) }} }}
                gravity (0, -{G});
                contacts {{ floor {{ corners: outline, on: box, {contacts}, restitution: e, friction: 0.2, order: sequence }} }}
            }}"
        );
        Scratch::new("bounces.machine", &spec)
    };
    let line = floor("along: ground");
    let plate = floor("against: ((-1, -0.3), (1, -0.3), (1, 0), (-1, 0)), of: ground");
    for drop in [1e-13_f64, 1e-10, 1e-6] {
        for e in [0.0, 0.3, 0.8] {
            let settings = [format!("drop={drop}"), format!("e={e}")];
            let settings = [settings[0].as_str(), settings[1].as_str()];
            let [on_line, on_plate] =
                [line.path(), plate.path()].map(|spec| simulate(spec, 0.1, &settings));
            for run in [&on_line, &on_plate] {
                is_good(run);
                close(number(&run["q"]["y"]), 0.1, 1e-12);
                // Friction moves it no faster than it fell, while it bounces for (1 + e)/(1 − e) times as long.
                let way = 2.0 * drop * (1.0 + e) / (1.0 - e);
                close(number(&run["q"]["x"]), 0.3, way + 1e-12);
                close(number(&run["q"]["theta"]), 0.0, 1e-12);
                for name in ["x", "y", "theta"] {
                    close(number(&run["v"][name]), 0.0, 1e-12);
                }
                let first = events(run, "impact")
                    .first()
                    .map(|event| number(&event["t"]));
                // The height of the start is known to its rounding.
                let fall = (2.0 * drop / G).sqrt();
                close(first.expect("it falls"), fall, fall * 2e-17 / drop + 1e-15);
            }
        }
    }
}

/// A box without friction on a platform that is shaken keeps its velocity in space: `x = x₀ + (v₀ + a ω) t − a sin ω t` on the platform, where it turns round
/// twice in each period. Both of its corners that touch begin and cease to slip at once; that one could hold what the other one does not must not hold both.
#[test]
fn a_box_without_friction_slides_on_a_shaken_platform() {
    let spec = Scratch::new(
        "shaken.machine",
        "machine Shaken in plane {
            parameters { a: m = 0.1, w: rad/s = 7, v0: m/s = -0.4, mu: 1 = 0, g: m/s^2 = 9.81 }
            coordinates { x: m = 0.9, y: m = 0.2, theta: rad, der(x): m/s = v0 }
            frames { platform = ground.shift(a*sin(w*t), 0), held = platform.shift(x, y).turn(theta) }
            bodies { box { mass: 1.5, inertia: 0.02, frame: held } }
            gravity (0, -g);
            contacts {
                lies {
                    corners: ((-0.07, -0.2), (0.07, -0.2), (0.07, 0.2), (-0.07, 0.2)), on: box,
                    against: ((0, -0.2), (2, -0.2), (2, 0), (0, 0)), of: platform, restitution: 0, friction: mu,
                },
            }
        }",
    );
    let run = simulate(spec.path(), 1.7, &[]);
    is_good(&run);
    let (a, w, v0) = (0.1, 7.0, -0.4);
    close(
        number(&run["q"]["x"]),
        0.9 + (v0 + a * w) * 1.7 - a * (w * 1.7_f64).sin(),
        1e-12,
    );
    close(number(&run["q"]["theta"]), 0.0, 1e-13);
    close(number(&run["dissipated"]), 0.0, 1e-13);
    // v₀ + a ω (1 − cos ω t) = 0 four times in 1.9 periods, for each of the two corners.
    let first = (1.0 + v0 / (a * w)).acos() / w;
    let reverses = events(&run, "reverses");
    assert_eq!(reverses.len(), 8, "{run:#}");
    close(number(&reverses[0]["t"]), first, 1e-12);
}

/// A tilted box that falls onto yielding ground, bounces, slips and comes down on a face: on a line, and on a polygon.
#[test]
fn a_box_that_yields_on_a_polygon_moves_as_on_a_line() {
    let text = "machine Dropped in plane {
        parameters { m: kg = 2, b: m = 0.1, h: m = 0.05, g: m/s^2 = 9.81, K: N/m^(3/2) = 4e5, c: s/m = 0.2, mu: 1 = 0.3 }
        coordinates { x: m, y: m = 0.2, theta: rad = 0.3, der(x): m/s = 0.5, der(theta): rad/s = -1 }
        frames { held = ground.shift(x, y).turn(theta), floor = ground.shift(0, 0) }
        bodies { box { mass: m, inertia: m*(b^2 + h^2)/3, frame: held, outline: ((b, h), (-b, h), (-b, -h), (b, -h)) } }
        gravity (0, -g);
        contacts { lies { corners: outline, on: box, SURFACE, compliance: hunt_crossley(K, c), friction: mu } }
    }";
    let surfaces = [
        "along: floor",
        "against: ((-9, -1), (9, -1), (9, 0), (-9, 0)), of: ground",
    ];
    let [line, polygon] = surfaces.map(|surface| {
        let spec = Scratch::new("dropped.machine", &text.replace("SURFACE", surface));
        table(spec.path(), "0.6", "0.01", &[])
    });
    assert!(events(&polygon.run, "closes").len() > 3);
    assert!(number(&polygon.run["energy_residual"]).abs() < 1e-9);
    for name in [
        "x",
        "y",
        "theta",
        "der(x)",
        "der(y)",
        "der(theta)",
        "total energy",
    ] {
        let (one, other) = (line.column(name), polygon.column(name));
        for (row, (line, polygon)) in line.rows.iter().zip(&polygon.rows).enumerate() {
            // The same forces to rounding, 1e-15 of 1e3 N in steps of 1e-5 s, which a few bounces magnify.
            assert!(
                (line[one] - polygon[other]).abs() < 1e-7,
                "{name} in row {row}"
            );
        }
    }
}

/// A box hits the tip of a triangle with its face. By Hertz's law a free impact lasts 3.218065 (m²/(K² v))^(1/5) and returns the speed
/// (K. L. Johnson, Contact Mechanics, 1985, section 11.4).
#[test]
fn a_tip_that_yields_throws_a_box_back_as_hertz_says() {
    let spec = Scratch::new(
        "tip.machine",
        "machine Tip in plane {
            parameters { m: kg = 2, b: m = 0.1, h: m = 0.05, K: N/m^(3/2) = 4e5, v: m/s = 0.5 }
            coordinates { y: m = h + 0.01, der(y): m/s = -v }
            frames { held = ground.shift(0, y) }
            bodies { box { mass: m, inertia: m*(b^2 + h^2)/3, frame: held, outline: ((b, h), (-b, h), (-b, -h), (b, -h)) } }
            gravity none;
            contacts { tip { corners: outline, on: box, against: ((-1, -1), (1, -1), (0, 0)), of: ground, compliance: hertz(K) } }
        }",
    );
    let run = simulate(spec.path(), 0.1, &[]);
    let [closes, opens] = ["closes", "opens"].map(|kind| events(&run, kind));
    assert_eq!([closes.len(), opens.len()], [1, 1]);
    assert_eq!(closes[0]["contact"], "tip[7]");
    let [closes, opens] = [closes, opens].map(|events| number(&events[0]["t"]));
    close(closes, 0.01 / 0.5, 1e-10);
    let (m, k, v): (f64, f64, f64) = (2.0, 4e5, 0.5);
    close(
        opens - closes,
        3.218_065 * (m * m / (k * k * v)).powf(0.2),
        1e-7,
    );
    close(number(&run["v"]["y"]), 0.5, 1e-9);
}

/// Where a corner passes from one face of the other polygon to the next, its depth is that of both, so no energy is lost or gained.
#[test]
fn a_box_that_slides_off_a_tip_keeps_its_energy() {
    let spec = Scratch::new(
        "slides_off.machine",
        "machine SlidesOff in plane {
            parameters { m: kg = 2, b: m = 0.1, h: m = 0.05, K: N/m^(3/2) = 4e5, g: m/s^2 = 9.81 }
            coordinates { x: m = 0.06, y: m = 0.1, theta: rad = 0.2, der(theta): rad/s = -1 }
            frames { held = ground.shift(x, y).turn(theta) }
            bodies { box { mass: m, inertia: m*(b^2 + h^2)/3, frame: held, outline: ((b, h), (-b, h), (-b, -h), (b, -h)) } }
            gravity (0, -g);
            contacts { tip { corners: outline, on: box, against: ((-1, -1), (1, -1), (0, 0)), of: ground, compliance: hertz(K) } }
        }",
    );
    let run = simulate(spec.path(), 0.5, &[]);
    assert!(events(&run, "closes").len() > 1);
    // It falls by more than 0.3 m, 6 J.
    assert!(
        number(&run["energy_residual"]).abs() < 1e-8,
        "{}",
        run["energy_residual"]
    );
    assert!(number(&run["q"]["y"]) < -0.2, "{}", run["q"]);
}

/// Seven polygons between walls, of which some lie wedged when the run changes over to time stepping. A corner that has come in by one face by 1 µm is
/// centimetres behind another one, and may not be moved out by that: the bodies would gain the potential energy of centimetres, 0.03 J, as the balance of the energy showed.
/// Of a step the balance knows all powers to rounding, and energies are sums of some 10 J.
#[test]
fn wedged_polygons_are_not_moved_out_by_a_face_far_away() {
    let run = json(&[
        "simulate",
        "cli/tests/command/wedged_polygons.machine",
        "--until",
        "0.66",
        "--json",
    ]);
    let handovers = run["handovers"].as_array().map(Vec::len);
    assert_eq!(
        handovers,
        Some(1),
        "the run does not change over to time stepping"
    );
    let residual = number(&run["energy_residual"]);
    assert!(residual.abs() < 1e-9, "{residual:e}");
}
