//! The same machine written in two ways: with positions through frames and bodies, or through coordinates.
//! Each way either gives the reactions of Newton's law or is refused.

use std::fmt::Write;
use std::ops::{Add, Mul};

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{At, ContactForce, Machine, System, contact_forces};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::{Code, Report};
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::Dag;

use crate::support::random::SplitMix;

const GRAVITY: f64 = 9.81;

/// A quantity that varies in time: its value, its rate and its acceleration.
#[derive(Clone, Copy)]
struct Moving([f64; 3]);

impl Moving {
    fn constant(x: f64) -> Moving {
        Moving([x, 0.0, 0.0])
    }

    fn sin(self) -> Moving {
        let Moving([x, v, a]) = self;
        Moving([x.sin(), x.cos() * v, x.cos() * a - x.sin() * v * v])
    }

    fn cos(self) -> Moving {
        (self + Moving::constant(std::f64::consts::FRAC_PI_2)).sin()
    }
}

impl Add for Moving {
    type Output = Moving;
    fn add(self, other: Moving) -> Moving {
        Moving(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Mul<f64> for Moving {
    type Output = Moving;
    fn mul(self, factor: f64) -> Moving {
        Moving(self.0.map(|x| x * factor))
    }
}

/// A segment of the path from the ground to a point.
#[derive(Clone, Copy)]
enum Piece {
    /// A constant offset.
    Offset([f64; 2]),
    /// A displacement by a coordinate, in a direction.
    Along(usize, f64),
    /// A rod of this length, turned by a coordinate from this angle to the vertical.
    Rod(usize, f64, f64),
    /// A displacement that is a sine of time with this frequency.
    Shaken([f64; 2], f64),
}

impl Piece {
    fn text(self, names: &[String]) -> [String; 2] {
        match self {
            Piece::Offset(by) => by.map(|x| format!("{x}*L")),
            Piece::Along(i, angle) => [
                format!("{}*cos({angle})", names[i]),
                format!("{}*sin({angle})", names[i]),
            ],
            Piece::Rod(i, length, angle) => [
                format!("{length}*L*sin({} + {angle})", names[i]),
                format!("-{length}*L*cos({} + {angle})", names[i]),
            ],
            Piece::Shaken(by, w) => by.map(|x| format!("{x}*L*sin({w}*W*t)")),
        }
    }

    fn moving(self, q: &[Moving], t: Moving) -> [Moving; 2] {
        match self {
            Piece::Offset(by) => by.map(Moving::constant),
            Piece::Along(i, angle) => [q[i] * angle.cos(), q[i] * angle.sin()],
            Piece::Rod(i, length, angle) => {
                let angle = q[i] + Moving::constant(angle);
                [angle.sin() * length, angle.cos() * -length]
            }
            Piece::Shaken(by, w) => by.map(|x| (t * w).sin() * x),
        }
    }
}

fn sum(pieces: &[Piece], names: &[String]) -> String {
    let parts: Vec<[String; 2]> = pieces.iter().map(|piece| piece.text(names)).collect();
    let side = |k: usize| {
        let terms: Vec<&str> = parts.iter().map(|part| part[k].as_str()).collect();
        terms.join(" + ").replace("+ -", "- ")
    };
    format!("{}, {}", side(0), side(1))
}

struct Body {
    mass: f64,
    /// The path from the ground.
    way: Vec<Piece>,
    /// The guides that carry the body, as a matter of mechanics.
    on: Vec<usize>,
}

struct Guide {
    body: usize,
    angle: f64,
    friction: f64,
}

struct Drawn {
    text: String,
    names: Vec<String>,
    bodies: Vec<Body>,
    guides: Vec<Guide>,
    /// Springs between bodies: stiffness and free length.
    springs: Vec<(usize, usize, f64, f64)>,
    /// Forces that act on bodies.
    forces: Vec<(usize, [f64; 2])>,
    /// Whether the compiler must refuse the machine.
    is_open: bool,
}

/// Rounds a random number to two digits, so that the text states it exactly.
fn digits(random: &mut SplitMix, from: f64, to: f64) -> f64 {
    (random.uniform(from, to) * 100.0).round() / 100.0
}

/// Draws one or two carts on rails, perhaps a block that slides on the first, and bodies that hang on
/// these or on each other. Each body is built on the frame of its support, or with probability
/// `loose` is written in coordinates.
fn draw(random: &mut SplitMix, loose: f64) -> Drawn {
    let mut names: Vec<String> = Vec::new();
    let (mut frames, mut listed, mut sliding) = (String::new(), String::new(), String::new());
    let mut bodies: Vec<Body> = Vec::new();
    let mut guides = Vec::new();
    // The guides that carry each body according to the text.
    let mut carried: Vec<Vec<usize>> = Vec::new();
    let mut is_open = false;
    let carts = 1 + (random.next() % 2) as usize;
    let blocks = (random.next() % 2) as usize;
    for k in 0..carts + blocks {
        let is_block = k >= carts;
        let angle = digits(random, -0.6, 0.6);
        names.push(format!("x{k}"));
        let mut way = if is_block {
            bodies[0].way.clone()
        } else {
            vec![
                Piece::Offset([0.0, 2.0 * k as f64]),
                Piece::Shaken(
                    [digits(random, -0.2, 0.2), digits(random, -0.2, 0.2)],
                    digits(random, 1.0, 4.0),
                ),
            ]
        };
        let base = way.len();
        way.push(Piece::Along(k, angle));
        let on = if is_block {
            "c0".to_owned()
        } else {
            let by = sum(&way[..base], &names);
            write!(frames, "rail{k} = ground.shift({by}),").expect("a string");
            format!("rail{k}")
        };
        let is_loose = random.unit() < loose;
        let frame = if is_loose {
            format!("ground.shift({})", sum(&way, &names))
        } else {
            format!("{on}.shift({})", sum(&way[base..], &names))
        };
        write!(frames, "c{k} = {frame},").expect("a string");
        let mass = digits(random, 0.5, 3.0);
        write!(listed, "c{k} {{ mass: {mass}, frame: c{k} }},").expect("a string");
        let friction = digits(random, 0.01, 0.3);
        write!(
            sliding,
            "g{k} {{ body: c{k}, on: {on}, direction: (cos({angle}), sin({angle})), friction: {friction} }},"
        )
        .expect("a string");
        let on = if is_block { vec![0, k] } else { vec![k] };
        carried.push(if is_loose { vec![k] } else { on.clone() });
        bodies.push(Body { mass, way, on });
        guides.push(Guide {
            body: k,
            angle,
            friction,
        });
    }
    for k in bodies.len()..bodies.len() + 1 + (random.next() % 3) as usize {
        let parent = (random.next() % k as u64) as usize;
        let piece = match random.next() % 4 {
            0 => Piece::Offset([digits(random, -1.0, 1.0), digits(random, -1.0, 1.0)]),
            1 => {
                names.push(format!("s{k}"));
                Piece::Along(names.len() - 1, digits(random, -3.0, 3.0))
            }
            _ => {
                names.push(format!("phi{k}"));
                Piece::Rod(
                    names.len() - 1,
                    digits(random, 0.3, 1.5),
                    digits(random, -1.0, 1.0),
                )
            }
        };
        let mut way = bodies[parent].way.clone();
        way.push(piece);
        let is_loose = random.unit() < loose;
        let own = sum(&[piece], &names);
        let place = match (is_loose, random.next() % 2) {
            (true, 0) => format!("at: ({})", sum(&way, &names)),
            (true, _) => {
                write!(frames, "c{k} = ground.shift({}),", sum(&way, &names)).expect("a string");
                format!("frame: c{k}")
            }
            (false, _) => format!("at: c{parent}.at + ({own})"),
        };
        let mass = digits(random, 0.5, 3.0);
        write!(listed, "c{k} {{ mass: {mass}, {place} }},").expect("a string");
        let on = bodies[parent].on.clone();
        let as_written = if is_loose {
            Vec::new()
        } else {
            carried[parent].clone()
        };
        // The guide of a block written in coordinates ties it to its cart.
        let is_tied = on.last().is_some_and(|last| as_written.contains(last));
        is_open |= !is_tied;
        carried.push(as_written);
        bodies.push(Body { mass, way, on });
    }
    let (mut springs, mut forces) = (Vec::new(), Vec::new());
    let mut acting = [String::new(), String::new()];
    let count = bodies.len() as u64;
    let [one, other] = [0, 1].map(|_| (random.next() % count) as usize);
    if one != other {
        let (k, l) = (digits(random, 5.0, 40.0), digits(random, 0.1, 1.0));
        write!(
            acting[0],
            "s {{ stiffness: {k}*K, from: c{one}.at, to: c{other}.at, length: {l}*L }}"
        )
        .expect("a string");
        springs.push((one, other, k, l));
    }
    let at = (random.next() % count) as usize;
    let force = [digits(random, -9.0, 9.0), digits(random, -9.0, 9.0)];
    write!(
        acting[1],
        "f {{ at: c{at}.at, force: ({}*F, {}*F) }}",
        force[0], force[1]
    )
    .expect("a string");
    forces.push((at, force));
    let units: Vec<String> = names
        .iter()
        .map(|name| {
            format!(
                "{name}: {}",
                if name.starts_with("phi") { "rad" } else { "m" }
            )
        })
        .collect();
    let text = format!(
        "machine Drawn in plane {{
            parameters {{ L: m = 1, W: rad/s = 1, K: N/m = 1, F: N = 1, g: m/s^2 = {GRAVITY} }}
            coordinates {{ {} }}
            frames {{ {frames} }}
            bodies {{ {listed} }}
            gravity (0, -g);
            springs {{ {} }}
            forces {{ {} }}
            sliding {{ {sliding} }}
        }}",
        units.join(", "),
        acting[0],
        acting[1]
    );
    Drawn {
        text,
        names,
        bodies,
        guides,
        springs,
        forces,
        is_open,
    }
}

/// Compiles a text to a machine, or returns its errors.
pub(super) fn read(text: &str) -> Result<InterpretedMachine, Vec<(Code, String)>> {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let files = &mut Disk;
    let model = lagrangian_spec::model(&dag, "drawn", text, &[], files, &mut sources, &mut report);
    let compiled = model.and_then(|model| Compiled::new(model, &mut report));
    match compiled {
        Some(compiled) => Ok(InterpretedMachine::new(compiled.program.clone())),
        None => Err(report
            .diagnostics()
            .iter()
            .map(|d| (d.code, d.message.clone()))
            .collect()),
    }
}

impl Drawn {
    /// The force that a guide exerts on everything that it carries, by Newton's law: along and across the
    /// guide. Also returns the size of the terms.
    fn by_newton(&self, guide: usize, t: f64, states: &[Moving]) -> ([f64; 2], f64) {
        let t = Moving([t, 1.0, 0.0]);
        let place = |body: &Body| {
            let pieces = body.way.iter().map(|piece| piece.moving(states, t));
            pieces.fold([Moving::constant(0.0); 2], |[x, y], [by_x, by_y]| {
                [x + by_x, y + by_y]
            })
        };
        let (mut force, mut size) = ([0.0; 2], 0.0_f64);
        let mut add = |by: [f64; 2]| {
            for (force, by) in force.iter_mut().zip(by) {
                *force += by;
                size += by.abs();
            }
        };
        let is_carried = |body: usize| self.bodies[body].on.contains(&guide);
        for body in self.bodies.iter().filter(|body| body.on.contains(&guide)) {
            let [x, y] = place(body);
            add([body.mass * x.0[2], body.mass * y.0[2]]);
            add([0.0, body.mass * GRAVITY]);
        }
        for &(_, by) in self.forces.iter().filter(|(body, _)| is_carried(*body)) {
            add(by.map(|x| -x));
        }
        for &(one, other, stiffness, length) in &self.springs {
            let [from, to] = [one, other].map(|body| place(&self.bodies[body]).map(|x| x.0[0]));
            let arm = [to[0] - from[0], to[1] - from[1]];
            let distance = arm[0].hypot(arm[1]);
            let pull = stiffness * (distance - length) / distance;
            for (body, sign) in [(one, -1.0), (other, 1.0)] {
                if is_carried(body) {
                    add(arm.map(|x| sign * pull * x));
                }
            }
        }
        let (sin, cos) = self.guides[guide].angle.sin_cos();
        let along = force[0] * cos + force[1] * sin;
        ([along, force[1] * cos - force[0] * sin], size)
    }
}

#[test]
fn a_machine_has_the_reactions_of_newton_however_it_is_written_or_is_refused() {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let clock = now.expect("it is later than 1970").subsec_nanos().into();
    let seed = std::env::var("SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let seed = seed.unwrap_or(clock);
    println!("SEED={seed}");
    let mut random = SplitMix::new(seed);
    let (mut refused, mut compared) = (0, 0);
    for draw_number in 0..80 {
        let loose = if draw_number % 2 == 0 { 0.0 } else { 0.3 };
        let drawn = draw(&mut random, loose);
        let place = format!("seed {seed}, machine {draw_number}: {}", drawn.text);
        let machine = match read(&drawn.text) {
            Ok(machine) => machine,
            Err(found) => {
                let is_untied = found.iter().all(|(code, _)| *code == Code::Untied);
                assert!(drawn.is_open && is_untied, "{found:?}, {place}");
                refused += 1;
                continue;
            }
        };
        assert!(!drawn.is_open, "not refused, {place}");
        let system = machine.prepare();
        let u = system.default_inputs();
        for _ in 0..3 {
            let t = random.uniform(0.0, 5.0);
            let mut number = || {
                (0..drawn.names.len())
                    .map(|_| random.uniform(-1.5, 1.5))
                    .collect()
            };
            let (q, v): (Vec<f64>, Vec<f64>) = (number(), number());
            let mut a = vec![0.0; q.len()];
            let mut forces = vec![ContactForce::default(); drawn.guides.len()];
            let found = contact_forces(
                &system,
                At {
                    t,
                    q: &q,
                    v: &v,
                    u: &u,
                },
                &mut a,
                &mut [],
                &mut forces,
            );
            // A guide may jam; Coulomb's law then permits no motion.
            if found.is_err() {
                continue;
            }
            compared += 1;
            let states: Vec<Moving> = (0..q.len()).map(|i| Moving([q[i], v[i], a[i]])).collect();
            for (k, (guide, force)) in drawn.guides.iter().zip(&forces).enumerate() {
                let ([along, across], size) = drawn.by_newton(k, t, &states);
                // Round-off of accelerations, amplified by the condition of the mass matrix.
                let tolerance = 1e-10 * (1.0 + size);
                let right = (force.friction - along).abs() <= tolerance
                    && (force.normal - across).abs() <= tolerance;
                assert!(
                    right,
                    "{force:?}, by Newton {along} and {across}, guide {k}, {place}"
                );
                assert_eq!(guide.body, k);
                let limit = guide.friction * force.normal.abs();
                assert!(
                    (force.friction.abs() - limit).abs() <= tolerance,
                    "{force:?}, {place}"
                );
            }
        }
    }
    assert!(
        refused > 5 && compared > 100,
        "{refused} refused, {compared} compared"
    );
}
