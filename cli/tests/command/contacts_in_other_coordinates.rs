//! What falls, collides and slides moves alike in whatever coordinates and frames a spec writes it.

use std::fmt::Write as _;

use serde_json::Value;

use crate::collisions::{close, events, number, simulate};
use crate::contacts_in_any_order::Drawn;
use crate::support::{Scratch, lagrangian};

const UNTIL: f64 = 0.5;
const TOLERANCE: f64 = 1e-11;
/// The distance from the start at which another run begins, to measure the growth of errors.
const BESIDE: f64 = 1e-7;
/// The point about which polar coordinates are.
const POLE: [f64; 2] = [-3.0, -2.0];
/// The angle of a ground that is turned.
const TURNED: f64 = 0.7;

/// A disc or a box: mass, size, pose and its rate in the ground's axes.
struct Body {
    is_box: bool,
    mass: f64,
    radius: f64,
    pose: [f64; 3],
    rate: [f64; 3],
}

/// Bodies that are thrown between a floor and two walls, which may turn, and the laws of their contacts.
struct Scene {
    bodies: Vec<Body>,
    turning: f64,
    slope: f64,
    contacts: Vec<(String, String)>,
}

impl Scene {
    fn new(seed: u64) -> Scene {
        let mut drawn = Drawn::new(seed);
        let count = 1 + seed as usize % 3;
        let of_kind = seed / 3 % 3;
        let bodies: Vec<Body> = (0..count)
            .map(|k| {
                let mut about = |middle: f64, by: f64| drawn.between(middle - by, middle + by);
                let [x, y] = [0.4 * (k % 2) as f64 - 0.2, 0.22 + 0.3 * (k / 2) as f64];
                Body {
                    is_box: of_kind == 1 || of_kind == 2 && k % 2 == 1,
                    mass: about(1.2, 0.7),
                    radius: about(0.08, 0.02),
                    pose: [about(x, 0.03), about(y, 0.03), about(0.0, 1.0)],
                    rate: [about(0.0, 1.5), about(0.0, 1.5), about(0.0, 1.5)],
                }
            })
            .collect();
        let touching = |k: usize| {
            if bodies[k].is_box {
                format!("corners: outline, on: b{k}")
            } else {
                format!("circle: c{k}")
            }
        };
        let mut contacts = Vec::new();
        let mut contact = |name: String, bodies: String| {
            // No contact closes for good in this time, so that the instants of all impacts are comparable.
            let (e, mu) = (drawn.between(0.5, 0.9), drawn.between(0.0, 0.7));
            let law = format!("{bodies}, restitution: {e:.3}, friction: {mu:.3}");
            contacts.push((name, law));
        };
        for k in 0..count {
            for wall in ["floor", "west", "east"] {
                contact(
                    format!("{wall}{k}"),
                    format!("{}, along: {wall}", touching(k)),
                );
            }
            for other in (0..k).filter(|other| bodies[*other].is_box == bodies[k].is_box) {
                let against = if bodies[k].is_box {
                    format!("against: outline, of: b{other}")
                } else {
                    format!("outside: c{other}")
                };
                contact(
                    format!("b{k}with{other}"),
                    format!("{}, {against}", touching(k)),
                );
            }
        }
        Scene {
            bodies,
            turning: [0.0, 1.3, 0.0, -1.7][seed as usize % 4],
            slope: drawn.between(-0.3, 0.3),
            contacts,
        }
    }
}

/// How the positions of bodies are written.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Coordinates {
    Cartesian,
    /// Half of x, 3 m less y, and three times the angle.
    Scaled,
    /// Each body relative to the one before.
    Relative,
    Polar,
}

/// What the coordinates are relative to.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Base {
    Ground,
    Turned,
    Moving,
    Accelerated,
    /// The walls, which turn.
    Walls,
}

/// A way to write a scene: its coordinates, their base, and the angle by which the axes of bodies are turned.
type Way = (Coordinates, Base, f64);

/// The names, start values and rates of the three coordinates of each body.
struct Start(Vec<[(f64, f64); 3]>);

impl Scene {
    /// The values and rates of the coordinates in which a scene is written.
    fn start(&self, (coordinates, base, _): Way) -> Start {
        let mut before: Option<([f64; 3], [f64; 3])> = None;
        let own = self.bodies.iter().map(|body| {
            let ([x, y, p], [vx, vy, w]) = (body.pose, body.rate);
            let turning = if base == Base::Walls {
                self.turning
            } else {
                0.0
            };
            let [vx, vy, w] = [vx + turning * y, vy - turning * x, w - turning];
            match coordinates {
                Coordinates::Cartesian => [(x, vx), (y, vy), (p, w)],
                Coordinates::Scaled => [(x / 2.0, vx / 2.0), (3.0 - y, -vy), (3.0 * p, 3.0 * w)],
                Coordinates::Relative => {
                    let (pose, rate) = before.unwrap_or_default();
                    before = Some(([x, y, p], [vx, vy, w]));
                    [
                        (x - pose[0], vx - rate[0]),
                        (y - pose[1], vy - rate[1]),
                        (p - pose[2], w - rate[2]),
                    ]
                }
                Coordinates::Polar => {
                    let [dx, dy] = [x - POLE[0], y - POLE[1]];
                    let (distance, angle) = (dx.hypot(dy), dy.atan2(dx));
                    let along = (dx * vx + dy * vy) / distance;
                    let across = (dx * vy - dy * vx) / (distance * distance);
                    [(distance, along), (angle, across), (p, w)]
                }
            }
        });
        Start(own.collect())
    }

    /// The poses of all bodies in the axes of the ground of the first way, given the coordinates at the end.
    fn poses(&self, (coordinates, base, _): Way, values: &[[f64; 3]]) -> Vec<f64> {
        let mut before = [0.0; 3];
        let own = values.iter().map(|&[x, y, p]| {
            let pose = match coordinates {
                Coordinates::Cartesian => [x, y, p],
                Coordinates::Scaled => [2.0 * x, 3.0 - y, p / 3.0],
                Coordinates::Relative => {
                    before = [before[0] + x, before[1] + y, before[2] + p];
                    before
                }
                Coordinates::Polar => [POLE[0] + x * y.cos(), POLE[1] + x * y.sin(), p],
            };
            if base != Base::Walls {
                return pose;
            }
            let turned = self.turning * UNTIL;
            let (sine, cosine) = turned.sin_cos();
            let [x, y, p] = pose;
            [cosine * x - sine * y, sine * x + cosine * y, p + turned]
        });
        own.flatten().collect()
    }

    /// The spec.
    fn written(&self, way: Way, start: &Start) -> String {
        let (coordinates, base, turned) = way;
        let number = |x: f64| format!("({x:?})");
        let (root, gravity) = match base {
            Base::Ground | Base::Walls => ("ground".to_owned(), [0.0, -9.81]),
            Base::Turned => (
                format!("ground.turn({TURNED})"),
                [9.81 * TURNED.sin(), -9.81 * TURNED.cos()],
            ),
            Base::Moving => ("ground.shift(1.5*u*t, -0.7*u*t)".to_owned(), [0.0, -9.81]),
            // The acceleration of the ground is (1, 2) m/s².
            Base::Accelerated => ("ground.shift(0.5*a*t^2, a*t^2)".to_owned(), [1.0, -7.81]),
        };
        let world = if base == Base::Walls { "walls" } else { "root" };
        let (mut list, mut frames, mut bodies, mut circles) =
            (String::new(), String::new(), String::new(), String::new());
        let mut previous = ["0*l", "0*l", "0"].map(str::to_owned);
        for (k, (body, own)) in self.bodies.iter().zip(&start.0).enumerate() {
            let units = match coordinates {
                Coordinates::Cartesian | Coordinates::Relative => ["m", "m", "rad"],
                Coordinates::Scaled => ["1", "m", "rad"],
                Coordinates::Polar => ["m", "rad", "rad"],
            };
            for ((name, unit), (value, rate)) in ["x", "y", "p"].iter().zip(units).zip(own) {
                let [value, rate] = [value, rate].map(|x| number(*x));
                let per = if unit == "1" {
                    "1/s".to_owned()
                } else {
                    format!("{unit}/s")
                };
                let _ = write!(
                    list,
                    "{name}{k}: {unit} = {value}, der({name}{k}): {per} = {rate}, "
                );
            }
            let [x, y, p] = match coordinates {
                Coordinates::Cartesian => [format!("x{k}"), format!("y{k}"), format!("p{k}")],
                Coordinates::Scaled => [
                    format!("2*l*x{k}"),
                    format!("(3*l - y{k})"),
                    format!("p{k}/3"),
                ],
                Coordinates::Relative => {
                    let each = previous.iter().zip(["x", "y", "p"]);
                    let each: Vec<_> = each
                        .map(|(from, name)| format!("({from} + {name}{k})"))
                        .collect();
                    each.try_into().expect("three")
                }
                Coordinates::Polar => [
                    format!("({}*l + x{k}*cos(y{k}))", number(POLE[0])),
                    format!("({}*l + x{k}*sin(y{k}))", number(POLE[1])),
                    format!("p{k}"),
                ],
            };
            let _ = write!(
                frames,
                "f{k} = {world}.shift({x}, {y}).turn({p} + {}), ",
                number(turned)
            );
            previous = [x, y, p];
            let (m, r) = (body.mass, body.radius);
            let mut outline = String::new();
            if body.is_box {
                let (sine, cosine) = turned.sin_cos();
                let corners = [(r, -0.7 * r), (r, 0.7 * r), (-r, 0.7 * r), (-r, -0.7 * r)];
                let corners = corners.map(|(u, v)| {
                    let [u, v] = [cosine * u + sine * v, cosine * v - sine * u].map(number);
                    format!("({u}*l, {v}*l)")
                });
                outline = format!(", outline: ({})", corners.join(", "));
            } else {
                let _ = write!(
                    circles,
                    "c{k} {{ on: f{k}, center: (0, 0), radius: {r:?} }}, "
                );
            }
            let inertia = 0.5 * m * r * r;
            let _ = write!(
                bodies,
                "b{k} {{ mass: {m:?}, inertia: {inertia:?}, frame: f{k}{outline} }}, "
            );
        }
        if !circles.is_empty() {
            circles = format!("circles {{ {circles} }}");
        }
        let contacts = self
            .contacts
            .iter()
            .map(|(name, law)| format!("{name} {{ {law} }}"));
        let contacts: Vec<String> = contacts.collect();
        format!(
            "machine Scene in plane {{
    constants {{ l: m = 1, s: s = 1, u: m/s = 1, a: m/s^2 = 1 }}
    coordinates {{ {list} }}
    frames {{
        root = {root}, walls = root.turn({}*t/s), floor = walls.turn({}),
        west = walls.shift(-0.45*l, 0*l).turn(-pi/2), east = walls.shift(0.45*l, 0*l).turn(pi/2), {frames}
    }}
    bodies {{ {bodies} }}
    {circles}
    gravity ({:?}, {:?});
    contacts {{ {} }}
}}",
            number(self.turning),
            number(self.slope),
            gravity[0],
            gravity[1],
            contacts.join(",\n        "),
        )
    }
}

/// The end of a run: poses, the contacts that changed and how, when, and the number of steps.
struct End {
    poses: Vec<f64>,
    events: Vec<(String, String)>,
    times: Vec<f64>,
    steps: f64,
}

impl End {
    /// The number of events before a contact closes for good. How many impacts that takes is a matter of rounding, and the instant is known within a bound
    /// that the run prints.
    fn flight(&self) -> usize {
        let closes = self.events.iter().position(|(_, kind)| kind == "closes");
        closes.unwrap_or(self.events.len())
    }
}

fn run(scene: &Scene, way: Way, start: &Start) -> End {
    let text = scene.written(way, start);
    let spec = Scratch::new("scene.machine", &text);
    let (until, tolerance) = (UNTIL.to_string(), TOLERANCE.to_string());
    let output = lagrangian(&[
        "simulate",
        spec.path(),
        "--until",
        &until,
        "--tolerance",
        &tolerance,
        "--method",
        "dop853",
        "--json",
    ]);
    let run: Value = serde_json::from_slice(&output.stdout).expect("a document");
    assert_eq!(run["error"], Value::Null, "{way:?}: {run:#}\n{text}");
    let value = |name: &str, k: usize| run["q"][format!("{name}{k}")].as_f64().expect("a number");
    let values = (0..scene.bodies.len()).map(|k| ["x", "y", "p"].map(|name| value(name, k)));
    let events = run["contact_events"].as_array().expect("events");
    let word = |event: &Value, what: &str| event[what].as_str().expect("a word").to_owned();
    let words = events
        .iter()
        .map(|event| (word(event, "contact"), word(event, "kind")));
    End {
        poses: scene.poses(way, &values.collect::<Vec<_>>()),
        events: words.collect(),
        times: events
            .iter()
            .map(|event| event["t"].as_f64().expect("a time"))
            .collect(),
        steps: run["steps"].as_f64().expect("a number"),
    }
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |most, (a, b)| (a - b).abs().max(most))
}

/// The same impacts happen at the same instants, and the bodies end in the same poses.
///
/// The error of a step is the tolerance for each coordinate and rate, and grows along the run as the distance of a neighbouring motion does.
#[test]
fn scenes_in_other_coordinates_and_frames_have_the_same_impacts() {
    use Base::{Accelerated, Ground, Moving, Turned, Walls};
    use Coordinates::{Cartesian, Polar, Relative, Scaled};
    let ways: [Way; 5] = [
        (Scaled, Turned, 0.0),
        (Relative, Moving, 0.4),
        (Polar, Accelerated, 0.0),
        (Polar, Walls, -1.1),
        (Relative, Ground, 0.0),
    ];
    let (mut impacts, mut ends) = (0, 0);
    for seed in 0..12 {
        let scene = Scene::new(seed);
        let plain = (Cartesian, Ground, 0.0);
        let start = scene.start(plain);
        let one = run(&scene, plain, &start);
        let mut beside = scene.start(plain);
        for (value, rate) in beside.0.iter_mut().flatten() {
            (*value, *rate) = (*value + BESIDE, *rate - BESIDE);
        }
        let neighbour = run(&scene, plain, &beside);
        let most = one.flight().min(neighbour.flight());
        assert_eq!(
            one.events[..most],
            neighbour.events[..most],
            "{seed}: choose another seed"
        );
        let growth = |a: &[f64], b: &[f64]| (apart(a, b) / BESIDE).max(1.0);
        let count = 6.0 * scene.bodies.len() as f64;
        let of_steps = 2.0 * one.steps * TOLERANCE * count;
        for way in ways {
            let other = run(&scene, way, &scene.start(way));
            let common = most.min(other.flight());
            let [events, others] = [&one, &other].map(|run| &run.events[..common]);
            assert_eq!(events, others, "{seed} {way:?}");
            let [times, others, neighbours] =
                [&one, &other, &neighbour].map(|run| &run.times[..common]);
            let within = of_steps * growth(times, neighbours);
            let error = apart(times, others);
            assert!(error <= within, "{seed} {way:?}: {error:e} s, {within:e} s");
            if common < one.events.len() {
                continue;
            }
            assert_eq!(one.events, other.events, "{seed} {way:?}");
            // Coordinates of up to 6 m are rounded to the tolerance times their size.
            let within = 6.0 * of_steps * growth(&one.poses, &neighbour.poses);
            let error = apart(&one.poses, &other.poses);
            assert!(error <= within, "{seed} {way:?}: {error:e}, {within:e}");
            ends += 1;
        }
        impacts += one.flight();
    }
    println!("{impacts} impacts, {ends} ends");
    assert!(
        impacts > 40 && ends > 20,
        "only {impacts} impacts and {ends} ends"
    );
}

/// A gap whose numbers are large is not multiplied out: of `x² − 8002 x + 16008001`, whose terms are a billion times their sum where the gap closes, the root
/// has half of the digits or none, and an impact was missed. A ball runs against a post with 1 m/s from 0.9 m before it, at 4 km and at 4000 km.
#[test]
fn a_gap_far_from_the_origin_closes_where_it_does() {
    for far in [0.0, 4e3, 4e6] {
        let spec = Scratch::new(
            "post.machine",
            &format!(
                "machine Post in plane {{
                    coordinates {{ x: m = {far:?}, y: m = 0.3, der(x): m/s = 1 }}
                    bodies {{ ball {{ mass: 1, at: (x, y) }} }}
                    contacts {{ post {{ gap: sqrt((x - {:?}*m)^2 + (y - 0.3*m)^2) - 0.1*m, restitution: 0.5 }} }}
                    gravity none;
                }}",
                far + 1.0,
            ),
        );
        let run = simulate(spec.path(), 2.0, &[]);
        let impacts = events(&run, "impact");
        assert_eq!(impacts.len(), 1, "at {far:e} m");
        // Round-off of the position, which passes with 1 m/s.
        let bound = 8.0 * f64::EPSILON * (far + 1.0);
        close(number(&impacts[0]["t"]), 0.9, bound);
    }
}

/// A ball in a round bowl falls onto its ground and bounces until it rests, and does the same wherever the origin of the coordinates is. The rows of
/// its gap are no weaker for that: the gap of 2 m turns over 2 m, not over the 4000 km to the origin.
#[test]
fn bounces_far_from_the_origin_end_as_there() {
    let bowl = |far: f64| {
        Scratch::new(
            "bowl.machine",
            &format!(
                "machine Bowl in plane {{
                    coordinates {{ x: m = {far:?}, y: m = 0.5 }}
                    bodies {{ ball {{ mass: 1, at: (x, y) }} }}
                    contacts {{ bowl {{ gap: 2*m - sqrt((x - {far:?}*m)^2 + (y - 1.5*m)^2), restitution: 0.5 }} }}
                    gravity (0, -9.81);
                }}"
            ),
        )
    };
    let of = |run: &Value, far: f64| {
        let closed = events(run, "closes");
        assert_eq!(closed.len(), 1, "at {far:e} m: {:#?}", run["error"]);
        number(&closed[0]["t"])
    };
    // Falling from 1 m above the ground, with bounces of half the rate, it rests after 3 times the time of the fall.
    let fall = f64::sqrt(2.0 / 9.81);
    for far in [0.0, 4e3, 40_000.5, 4_000_000.5] {
        let run = simulate(bowl(far).path(), 2.0, &[]);
        close(of(&run, far), 3.0 * fall, 1e-6);
        close(number(&run["q"]["y"]), -0.5, 1e-12);
        close(number(&run["v"]["y"]), 0.0, 1e-12);
        close(number(&run["dissipated"]), 9.81, 1e-10);
    }
}
