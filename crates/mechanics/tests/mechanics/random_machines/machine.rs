//! Random machines as the text of a spec and as numbers: a tree of frames, bodies on them, and elements between them.

use std::fmt::Write as _;

use super::number::Number;
use super::random::Random;

/// A random machine. Every number in it is a multiple of 1/64, so that the text, binary64 and 120 digits agree exactly.
#[derive(Debug)]
pub struct Machine {
    pub spatial: bool,
    pub coordinates: usize,
    /// Frame k is made from frame `parent` (0 is the ground, k counts from 1).
    pub frames: Vec<Frame>,
    pub bodies: Vec<Body>,
    pub gravity: [f64; 3],
    pub springs: Vec<Spring>,
    pub dampers: Vec<Damper>,
    pub forces: Vec<Force>,
}

#[derive(Debug)]
pub struct Frame {
    pub parent: usize,
    pub step: Step,
}

#[derive(Debug)]
pub enum Step {
    Shift([Linear; 3]),
    Turn(usize, Linear),
}

/// c + Σ cᵢ qᵢ + c_t t + s sin(w t): the form of all displacements and angles.
#[derive(Clone, Debug, Default)]
pub struct Linear {
    pub constant: f64,
    pub coordinate: Vec<(usize, f64)>,
    pub time: f64,
    /// Amplitude and frequency of a drive.
    pub drive: Option<(f64, f64)>,
}

#[derive(Debug)]
pub struct Body {
    pub frame: usize,
    pub offset: [f64; 3],
    pub mass: f64,
    /// One moment of inertia in the plane, six entries in space; `None` for a particle.
    pub inertia: Option<[f64; 6]>,
}

#[derive(Debug)]
pub struct Spring {
    pub stiffness: f64,
    pub stretch: Stretch,
}

#[derive(Debug)]
pub enum Stretch {
    Linear(Linear),
    /// The distance between two bodies minus a length.
    Bodies(usize, usize, f64),
}

#[derive(Debug)]
pub struct Damper {
    pub damping: f64,
    pub stretch: Stretch,
}

/// A force in ground axes at a body's mass centre; its size depends on time and on a rate.
#[derive(Debug)]
pub struct Force {
    pub body: usize,
    pub force: [f64; 3],
    pub velocity: usize,
}

impl Machine {
    /// A machine with this many coordinates, each of which moves a frame that carries a body.
    pub fn random(random: &mut Random, spatial: bool, coordinates: usize) -> Machine {
        let dimension = if spatial { 3 } else { 2 };
        let mut frames: Vec<Frame> = Vec::new();
        let mut bodies = Vec::new();
        for coordinate in 0..coordinates {
            let parent = random.below(frames.len() + 1);
            let mut moved = Linear {
                coordinate: vec![(coordinate, 1.0)],
                ..Linear::default()
            };
            if coordinate > 0 && random.chance(30) {
                moved
                    .coordinate
                    .push((random.below(coordinate), random.number(-1.0, 1.0)));
            }
            if random.chance(25) {
                moved.time = random.number(-2.0, 2.0);
            }
            if random.chance(25) {
                moved.drive = Some((random.number(-1.0, 1.0), random.number(0.5, 3.0)));
            }
            let step = if random.chance(60) {
                Step::Turn(if spatial { random.below(3) } else { 2 }, moved)
            } else {
                let mut shift: [Linear; 3] = Default::default();
                shift[random.below(dimension)] = moved;
                Step::Shift(shift)
            };
            frames.push(Frame { parent, step });
            // A constant shift, so that successive rotations are not about the same point;
            // in either order, for variety.
            let mut arm: [Linear; 3] = Default::default();
            for component in arm.iter_mut().take(dimension) {
                component.constant = random.number(0.25, 1.0);
            }
            frames.push(Frame {
                parent: frames.len(),
                step: Step::Shift(arm),
            });
            let mut offset = [0.0; 3];
            offset
                .iter_mut()
                .take(dimension)
                .for_each(|x| *x = random.number(-0.5, 0.5));
            // Positive definite by diagonal dominance: moments at least 1, products at most 1/4.
            let inertia = random.chance(75).then(|| {
                let mut entries = [0.0; 6];
                for (k, entry) in entries.iter_mut().enumerate() {
                    *entry = if k < 3 {
                        random.number(1.0, 2.0)
                    } else {
                        random.number(-0.25, 0.25)
                    };
                }
                entries
            });
            bodies.push(Body {
                frame: frames.len(),
                offset,
                mass: random.number(0.5, 3.0),
                inertia,
            });
        }
        let mut machine = Machine {
            spatial,
            coordinates,
            frames,
            bodies,
            gravity: [
                random.number(-1.0, 1.0),
                random.number(-10.0, 0.0),
                random.number(-10.0, 0.0),
            ],
            springs: Vec::new(),
            dampers: Vec::new(),
            forces: Vec::new(),
        };
        for _ in 0..random.below(3) {
            let stretch = machine.stretch(random);
            machine.springs.push(Spring {
                stiffness: random.number(1.0, 20.0),
                stretch,
            });
        }
        for _ in 0..random.below(3) {
            let stretch = machine.stretch(random);
            machine.dampers.push(Damper {
                damping: random.number(0.25, 2.0),
                stretch,
            });
        }
        for _ in 0..random.below(2) {
            let mut force = [0.0; 3];
            force
                .iter_mut()
                .take(dimension)
                .for_each(|x| *x = random.number(-3.0, 3.0));
            let (body, velocity) = (
                random.below(machine.bodies.len()),
                random.below(coordinates),
            );
            machine.forces.push(Force {
                body,
                force,
                velocity,
            });
        }
        machine
    }

    /// A planar machine in which a coordinate is the abscissa of one body and the ordinate of another, so that bodies
    /// share velocities along different axes, in any order of bodies. Some carry an arm that rotates.
    pub fn sharing(random: &mut Random, coordinates: usize) -> Machine {
        let own = |coordinate: usize, factor: f64| Linear {
            coordinate: vec![(coordinate, factor)],
            ..Linear::default()
        };
        let mut pool: Vec<Linear> = (0..coordinates).map(|k| own(k, 1.0)).collect();
        pool.push(Linear::default());
        for _ in 0..2 {
            let mut linear = own(random.below(coordinates), [1.0, -1.0, 2.0][random.below(3)]);
            linear
                .coordinate
                .push((random.below(coordinates), random.number(-1.0, 1.0)));
            pool.push(linear);
        }
        let mut frames = Vec::new();
        let mut bodies = Vec::new();
        // Each coordinate moves a mass of its own, so the mass matrix is positive definite.
        for k in 0..coordinates + 2 {
            let first = if k < coordinates {
                k
            } else {
                random.below(pool.len())
            };
            let mut at = [
                pool[first].clone(),
                pool[random.below(pool.len())].clone(),
                Linear::default(),
            ];
            if random.chance(50) {
                at.swap(0, 1);
            }
            frames.push(Frame {
                parent: 0,
                step: Step::Shift(at),
            });
            if random.chance(40) {
                let angle = own(random.below(coordinates), random.number(0.5, 1.5));
                frames.push(Frame {
                    parent: frames.len(),
                    step: Step::Turn(2, angle),
                });
                let arm = [0.25, 0.5, 0.0].map(|constant| Linear {
                    constant,
                    ..Linear::default()
                });
                frames.push(Frame {
                    parent: frames.len(),
                    step: Step::Shift(arm),
                });
                bodies.push(Body {
                    frame: frames.len(),
                    offset: [0.0; 3],
                    mass: random.number(0.5, 3.0),
                    inertia: random.chance(50).then_some([1.0; 6]),
                });
            }
            let is_on_arm = !bodies.is_empty() && random.chance(20) && k >= coordinates;
            bodies.push(Body {
                frame: if is_on_arm {
                    bodies[random.below(bodies.len())].frame
                } else {
                    root_of(&frames)
                },
                offset: [0.0; 3],
                mass: random.number(0.5, 3.0),
                inertia: None,
            });
        }
        for last in (1..bodies.len()).rev() {
            bodies.swap(last, random.below(last + 1));
        }
        Machine {
            spatial: false,
            coordinates,
            frames,
            bodies,
            gravity: [
                if random.chance(50) {
                    0.0
                } else {
                    random.number(-3.0, 3.0)
                },
                random.number(-10.0, -1.0),
                0.0,
            ],
            springs: Vec::new(),
            dampers: Vec::new(),
            forces: Vec::new(),
        }
    }

    fn stretch(&self, random: &mut Random) -> Stretch {
        let (a, b) = (
            random.below(self.bodies.len()),
            random.below(self.bodies.len()),
        );
        if a != b && random.chance(60) {
            return Stretch::Bodies(a, b, random.number(0.0, 1.0));
        }
        let mut linear = Linear {
            constant: random.number(-1.0, 1.0),
            ..Linear::default()
        };
        for coordinate in 0..self.coordinates {
            if random.chance(50) {
                linear
                    .coordinate
                    .push((coordinate, random.number(-1.0, 1.0)));
            }
        }
        if random.chance(30) {
            linear.time = random.number(-1.0, 1.0);
        }
        Stretch::Linear(linear)
    }

    /// The machine as a spec. Masses and stiffnesses are parameters, the rest literals.
    pub fn spec(&self) -> String {
        let dimension = if self.spatial { 3 } else { 2 };
        let vector = |x: &[f64]| {
            let parts: Vec<String> = x.iter().take(dimension).map(f64::to_string).collect();
            format!("({})", parts.join(", "))
        };
        let mut text = format!(
            "machine Random in {} {{\n",
            if self.spatial { "space" } else { "plane" }
        );
        let mut line = |indent: usize, words: String| {
            writeln!(text, "{:1$}{words}", "", 4 * indent).expect("text grows");
        };
        let parameters: Vec<String> = self
            .bodies
            .iter()
            .enumerate()
            .map(|(k, body)| format!("m{k}: kg = {}", body.mass))
            .collect();
        line(1, format!("parameters {{ {} }}", parameters.join(", ")));
        let names: Vec<String> = (0..self.coordinates).map(|k| format!("q{k}: 1")).collect();
        line(1, format!("coordinates {{ {} }}", names.join(", ")));
        line(1, "frames {".into());
        for (k, frame) in self.frames.iter().enumerate() {
            let parent = if frame.parent == 0 {
                "ground".into()
            } else {
                format!("f{}", frame.parent)
            };
            let step = match &frame.step {
                Step::Shift(shift) => {
                    let parts: Vec<String> = shift
                        .iter()
                        .take(dimension)
                        .map(|part| format!("({})*unit_length", part.text()))
                        .collect();
                    format!("shift({})", parts.join(", "))
                }
                Step::Turn(axis, angle) if self.spatial => {
                    format!("turn({}, {})", ["x", "y", "z"][*axis], angle.text())
                }
                Step::Turn(_, angle) => format!("turn({})", angle.text()),
            };
            line(2, format!("f{} = {parent}.{step},", k + 1));
        }
        line(1, "}".into());
        line(
            1,
            "constants { unit_length: m = 1, second: s = 1, newton: N = 1 }".into(),
        );
        line(1, "bodies {".into());
        for (k, body) in self.bodies.iter().enumerate() {
            let inertia = match (&body.inertia, self.spatial) {
                (None, _) => String::new(),
                (Some(entries), false) => format!("inertia: {}, ", entries[0]),
                (Some(entries), true) => {
                    let entries: Vec<String> = entries.iter().map(f64::to_string).collect();
                    format!("inertia: ({}), ", entries.join(", "))
                }
            };
            let offset = vector(&body.offset);
            line(
                2,
                format!(
                    "b{k} {{ mass: m{k}, {inertia}frame: f{}, at: f{}.point{offset} }},",
                    body.frame, body.frame
                ),
            );
        }
        line(1, "}".into());
        line(1, format!("gravity {};", vector(&self.gravity)));
        let stretch = |stretch: &Stretch, length: bool| match stretch {
            Stretch::Linear(linear) => format!("stretch: ({})*unit_length", linear.text()),
            Stretch::Bodies(a, b, l) if length => {
                format!("from: b{a}.at, to: b{b}.at, length: {l}")
            }
            Stretch::Bodies(a, b, _) => format!("from: b{a}.at, to: b{b}.at"),
        };
        for (k, spring) in self.springs.iter().enumerate() {
            let stretch = stretch(&spring.stretch, true);
            line(
                1,
                format!(
                    "springs {{ s{k} {{ stiffness: {}, {stretch} }} }}",
                    spring.stiffness
                ),
            );
        }
        for (k, damper) in self.dampers.iter().enumerate() {
            let stretch = stretch(&damper.stretch, false);
            line(
                1,
                format!(
                    "dampers {{ d{k} {{ damping: {}, {stretch} }} }}",
                    damper.damping
                ),
            );
        }
        for (k, force) in self.forces.iter().enumerate() {
            let size = format!("newton*(second*der(q{}) + cos(t/second))", force.velocity);
            line(
                1,
                format!(
                    "forces {{ a{k} {{ at: b{}.at, force: {size}*{} }} }}",
                    force.body,
                    vector(&force.force)
                ),
            );
        }
        text.push_str("}\n");
        text
    }
}

/// The number of the last frame on the ground.
fn root_of(frames: &[Frame]) -> usize {
    let root = frames.iter().rposition(|frame| frame.parent == 0);
    root.map_or(0, |root| root + 1)
}

impl Linear {
    fn text(&self) -> String {
        let mut text = self.constant.to_string();
        for (coordinate, factor) in &self.coordinate {
            write!(text, " + ({factor})*q{coordinate}").expect("text grows");
        }
        if self.time != 0.0 {
            write!(text, " + ({})*t/second", self.time).expect("text grows");
        }
        if let Some((amplitude, frequency)) = self.drive {
            write!(text, " + ({amplitude})*sin({frequency}*t/second)").expect("text grows");
        }
        text
    }

    /// The value in 120 digits.
    pub fn at(&self, q: &[Number], t: &Number) -> Number {
        let mut sum = Number::of(self.constant) + Number::of(self.time) * t;
        for (coordinate, factor) in &self.coordinate {
            sum = sum + Number::of(*factor) * &q[*coordinate];
        }
        if let Some((amplitude, frequency)) = self.drive {
            sum = sum + Number::of(amplitude) * (Number::of(frequency) * t).sin_cos().0;
        }
        sum
    }
}
