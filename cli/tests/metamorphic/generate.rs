//! Generates random machines.

use super::machine::{
    Approximation, Body, Bushing, Circle, Constraint, Coordinate, Elastic, Expr, Force, Frame,
    Guide, Loop, METRE, Machine, Meaning, NEWTON, PURE, Rolling, Step, Stretch, Surface, Value,
    Vector, cos, der, dot, mul, neg, norm, num, power, q, quotient, sin, sum,
};
use super::random::Random;
use super::truth::{State, World};

/// The kind of a random machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Bodies placed by formulas in the coordinates, which several bodies may share.
    Formulas,
    /// Bodies on a tree of frames.
    Tree,
    /// Closed loops of links.
    Closed,
    /// Rolling discs.
    Rolling,
    /// Bodies in guides with friction.
    Guided,
}

impl Kind {
    pub const ALL: [Kind; 5] = [
        Kind::Formulas,
        Kind::Tree,
        Kind::Closed,
        Kind::Rolling,
        Kind::Guided,
    ];
}

struct Builder<'r> {
    random: &'r mut Random,
    machine: Machine,
}

pub fn machine(random: &mut Random, kind: Kind) -> Machine {
    let machine = Machine::default();
    let mut builder = Builder { random, machine };
    for _ in 0..2 + builder.random.below(2) {
        let value = builder.random.number(0.5, 2.0);
        let name = format!("a{}", builder.machine.parameters.len());
        builder.machine.parameters.push(Value { name, value });
    }
    if builder.random.chance(40) {
        let value = builder.random.number(0.5, 2.0);
        builder.machine.constants.push(Value {
            name: "k0".into(),
            value,
        });
    }
    if builder.random.chance(25) {
        let value = builder.random.number(-2.0, 2.0);
        builder.machine.inputs.push(Value {
            name: "i0".into(),
            value,
        });
    }
    match kind {
        Kind::Formulas => builder.formulas(),
        Kind::Tree => builder.tree(),
        Kind::Closed => builder.closed(),
        Kind::Rolling => builder.rolling(),
        Kind::Guided => builder.guided(),
    }
    builder.act(kind);
    builder.machine
}

impl Builder<'_> {
    fn coordinate(&mut self) -> usize {
        let k = self.machine.coordinates.len();
        self.machine.coordinates.push(Coordinate {
            name: format!("x{k}"),
            start: self.random.number(-1.5, 1.5),
            rate: self.random.number(-1.5, 1.5),
            kept: [false; 2],
        });
        k
    }

    /// A positive number: a literal, a parameter, or a constant.
    fn positive(&mut self) -> Expr {
        match self.random.below(4) {
            0 => num(self.random.number(0.5, 2.0)),
            1 if !self.machine.constants.is_empty() => Expr::Constant(0),
            2 => mul(
                num(self.random.number(0.5, 1.5)),
                Expr::Parameter(self.random.below(self.machine.parameters.len())),
            ),
            _ => Expr::Parameter(self.random.below(self.machine.parameters.len())),
        }
    }

    fn factor(&mut self) -> Expr {
        let factors = [1.0, 2.0, 0.5, -1.0, -2.0, 1.5];
        num(factors[self.random.below(factors.len())])
    }

    fn any_coordinate(&mut self) -> usize {
        self.random.below(self.machine.coordinates.len())
    }

    fn drive(&mut self) -> Expr {
        let (amplitude, frequency) = (self.random.number(-0.5, 0.5), self.random.number(0.5, 3.0));
        mul(num(amplitude), sin(mul(num(frequency), Expr::Time)))
    }

    /// A component of a position.
    fn component(&mut self) -> Expr {
        let (i, j) = (self.any_coordinate(), self.any_coordinate());
        match self.random.below(11) {
            0..=2 => q(i),
            3 => mul(self.factor(), q(i)),
            4 => sum(vec![q(i), mul(self.factor(), q(j))]),
            5 => mul(self.positive(), sin(q(i))),
            6 => mul(self.positive(), cos(sum(vec![q(i), q(j)]))),
            7 => mul(num(0.25), mul(q(i), q(j))),
            8 => sum(vec![num(self.random.number(-1.0, 1.0)), self.drive()]),
            9 => sum(vec![q(i), self.positive()]),
            _ => num(self.random.number(-1.0, 1.0)),
        }
    }

    fn body(&mut self, frame: Option<usize>, at: Option<Vector>, angle: Option<Expr>) -> usize {
        let k = self.machine.bodies.len();
        let mass = self.positive();
        let turns = frame.is_some() || angle.is_some();
        let inertia = match (turns && self.random.chance(70), self.machine.spatial) {
            (false, _) => Vec::new(),
            (true, false) => vec![mul(
                mass.clone(),
                power(num(self.random.number(0.25, 1.0)), 4),
            )],
            (true, true) => {
                // Moments of masses at ±a, ±b, ±c along the axes, so they satisfy the triangle inequalities.
                let [a, b, c] = [0, 1, 2].map(|_| num(self.random.number(0.5, 1.0)));
                let third = |x: &Expr, y: &Expr| {
                    let squares = sum(vec![power(x.clone(), 4), power(y.clone(), 4)]);
                    quotient(mul(mass.clone(), squares), num(3.0))
                };
                let mut entries = vec![third(&b, &c), third(&a, &c), third(&a, &b)];
                if self.random.chance(40) {
                    // Products of inertia are less than an eighth of the smallest moment.
                    let products = (0..3).map(|_| num(self.random.number(-0.0625, 0.0625)));
                    entries.extend(products.map(|x| mul(mass.clone(), x)));
                }
                entries
            }
        };
        self.machine.bodies.push(Body {
            name: format!("b{k}"),
            mass,
            inertia,
            frame,
            at,
            angle,
        });
        k
    }

    fn formulas(&mut self) {
        self.machine.spatial = self.random.chance(30);
        let n = 1 + self.random.below(4);
        (0..n).for_each(|_| {
            self.coordinate();
        });
        let dimension = self.machine.dimension();
        let bodies = n + self.random.below(2);
        for k in 0..bodies {
            let mut at: Vec<Expr> = (0..dimension).map(|_| self.component()).collect();
            // Every coordinate moves a mass.
            if k < n {
                let place = self.random.below(dimension);
                at[place] = if self.random.chance(60) {
                    q(k)
                } else {
                    sum(vec![q(k), at[place].clone()])
                };
            }
            let angle = (!self.machine.spatial && self.random.chance(40)).then(|| {
                let i = self.any_coordinate();
                mul(self.factor(), q(i))
            });
            self.body(None, Some(Vector::Free(at, METRE)), angle);
        }
    }

    fn shift(&mut self, frame: usize, shift: Vec<Expr>) -> usize {
        self.machine.frames.push(Frame {
            parent: frame,
            step: Step::Shift(shift),
        });
        self.machine.frames.len()
    }

    fn turn(&mut self, frame: usize, axis: usize, angle: Expr) -> usize {
        self.machine.frames.push(Frame {
            parent: frame,
            step: Step::Turn(axis, angle),
        });
        self.machine.frames.len()
    }

    fn tree(&mut self) {
        self.machine.spatial = self.random.chance(35);
        let n = 1 + self.random.below(if self.machine.spatial { 3 } else { 4 });
        let dimension = self.machine.dimension();
        let mut tips = vec![0];
        for k in 0..n {
            self.coordinate();
            let parent = tips[self.random.below(tips.len())];
            let mut moved = vec![q(k)];
            if k > 0 && self.random.chance(30) {
                moved.push(mul(self.factor(), q(self.random.below(k))));
            }
            if self.random.chance(20) {
                moved.push(self.drive());
            }
            let moved = match moved.len() {
                1 => moved.remove(0),
                _ => sum(moved),
            };
            let axis = if self.machine.spatial {
                self.random.below(3)
            } else {
                2
            };
            let frame = if self.random.chance(60) {
                let turned = self.turn(parent, axis, moved);
                let arm = (0..dimension).map(|i| match i {
                    0 => self.positive(),
                    _ => num(self.random.number(-0.5, 0.5)),
                });
                let arm = arm.collect();
                self.shift(turned, arm)
            } else {
                let mut shift = vec![num(0.0); dimension];
                shift[self.random.below(dimension)] = moved;
                if self.random.chance(30) {
                    let other = self.random.below(dimension);
                    let component = self.component();
                    shift[other] = sum(vec![shift[other].clone(), component]);
                }
                self.shift(parent, shift)
            };
            tips.push(frame);
            let at = self.random.chance(50).then(|| {
                let offset = (0..dimension).map(|_| num(self.random.number(-0.5, 0.5)));
                Vector::Point(frame, offset.collect())
            });
            self.body(Some(frame), at, None);
        }
    }

    fn closed(&mut self) {
        let links = 3 + self.random.below(2);
        let lengths: Vec<Expr> = (0..links)
            .map(|k| match k {
                0 => num(self.random.number(0.5, 0.75)),
                _ => num(self.random.number(1.0, 1.5)),
            })
            .collect();
        for k in 0..links {
            self.coordinate();
            // Away from configurations in which the links are collinear.
            self.machine.coordinates[k].start = [1.25, 0.5, -0.75, -1.75][k];
            self.body(None, None, None);
        }
        let anchor = [
            num(self.random.number(1.5, 2.0)),
            num(self.random.number(-0.25, 0.25)),
        ];
        let cut = 1 + self.random.below(links);
        self.machine.closed = Some(Loop {
            lengths,
            anchor,
            cut,
        });
        for k in 0..links {
            let along = self.random.number(0.25, 0.75);
            let beside = self.random.number(-0.25, 0.25);
            let at = Vector::Point(0, vec![num(along), num(beside)]);
            let inertia = num(self.random.number(0.25, 1.0));
            let body = &mut self.machine.bodies[k];
            body.at = Some(at);
            if self.random.chance(70) {
                body.inertia = vec![inertia];
            }
        }
        close(&mut self.machine);
    }

    fn rolling(&mut self) {
        let [x, y, phi] = [0, 1, 2].map(|_| self.coordinate());
        let radius = num(self.random.number(0.25, 0.5));
        let centre = self.shift(0, vec![q(x), q(y)]);
        let disc = self.turn(centre, 2, q(phi));
        let at = self.random.chance(40).then(|| {
            let offset = [0, 1].map(|_| num(self.random.number(-0.125, 0.125)));
            Vector::Point(disc, offset.to_vec())
        });
        let mass = self.positive();
        self.machine.bodies.push(Body {
            name: "b0".into(),
            inertia: vec![mul(mass.clone(), num(self.random.number(0.0625, 0.25)))],
            mass,
            frame: Some(disc),
            at,
            angle: None,
        });
        let mut circle = |on, radius: &Expr| {
            self.machine.circles.push(Circle {
                on,
                centre: [num(0.0), num(0.0)],
                radius: radius.clone(),
            });
            self.machine.circles.len() - 1
        };
        let own = circle(Ok(disc), &radius);
        let surface = if self.random.chance(40) {
            let mut frame = 0;
            if self.random.chance(70) {
                let slope = self.random.number(-0.5, 0.5);
                frame = self.turn(0, 2, num(slope));
            }
            if self.random.chance(40) {
                let drive = self.drive();
                frame = self.shift(frame, vec![num(0.25), drive]);
            }
            let start = &mut self.machine.coordinates;
            (start[x].start, start[y].start) = (0.25, 0.5);
            Surface::Along(frame)
        } else {
            let inside = self.random.chance(50);
            let drum = num(self.random.number(1.0, 1.5));
            let turned = self.coordinate();
            let moved = self.random.chance(40);
            let shift = if moved {
                let across = self.coordinate();
                vec![q(across), num(0.25)]
            } else {
                vec![num(0.125), num(-0.25)]
            };
            let frame = self.shift(0, shift);
            let by_angle = self.random.chance(50);
            let frame = if by_angle {
                frame
            } else {
                self.turn(frame, 2, q(turned))
            };
            let mass = self.positive();
            self.machine.bodies.push(Body {
                name: "b1".into(),
                inertia: vec![mul(mass.clone(), num(0.75))],
                mass,
                frame: (!by_angle).then_some(frame),
                at: by_angle.then_some(Vector::Origin(frame)),
                angle: by_angle.then_some(q(turned)),
            });
            let on = if by_angle { Err(1) } else { Ok(frame) };
            self.machine.circles.push(Circle {
                on,
                centre: [num(0.0), num(0.0)],
                radius: drum,
            });
            let start = &mut self.machine.coordinates;
            let distance = if inside { 0.75 } else { 1.5 };
            (start[x].start, start[y].start) = (0.5 * distance, 0.875 * distance);
            if moved {
                start[4].start = 0.125;
            }
            if inside {
                Surface::Inside(1)
            } else {
                Surface::Outside(1)
            }
        };
        self.machine.rolling.push(Rolling {
            name: "rolls".into(),
            circle: own,
            surface,
        });
        self.machine.gravity = Some(vec![num(0.5), num(-9.0)]);
    }

    fn guide(&mut self, body: usize, on: usize, direction: Vector, normal: Option<Vector>) {
        let k = self.machine.sliding.len();
        let friction = num(self.random.number(0.0, 0.375));
        let sticking = self.random.chance(30).then(|| num(0.5));
        let direction = if self.random.chance(40) {
            Vector::Scaled(num(self.random.number(0.25, 4.0)), Box::new(direction))
        } else {
            direction
        };
        self.machine.sliding.push(Guide {
            name: format!("g{k}"),
            body,
            on,
            direction,
            normal,
            friction,
            sticking,
        });
    }

    fn guided(&mut self) {
        let free = |x: Expr, y: Expr| Vector::Free(vec![x, y], PURE);
        let x = self.coordinate();
        let mut cart = 0;
        match self.random.below(4) {
            0 => {
                // A cart along the ground.
                cart = self.shift(cart, vec![q(x), num(0.0)]);
                let body = self.body(Some(cart), None, None);
                let normal = self.random.chance(30).then(|| free(num(0.0), num(-2.0)));
                self.guide(body, 0, free(num(1.0), num(0.0)), normal);
            }
            1 => {
                // A cart on a curve.
                let k = num(self.random.number(-1.0, 1.0));
                let height = mul(mul(num(0.5), k.clone()), power(q(x), 4));
                cart = self.shift(cart, vec![q(x), height]);
                let body = self.body(Some(cart), None, None);
                let slope = mul(k, q(x));
                let normal = self
                    .random
                    .chance(60)
                    .then(|| free(neg(slope.clone()), num(1.0)));
                self.guide(body, 0, free(num(1.0), slope), normal);
            }
            2 => {
                // A cart on a shaken rail.
                let drive = self.drive();
                let rail = self.shift(0, vec![drive, num(0.0)]);
                let drive = self.drive();
                let angle = sum(vec![num(self.random.number(-0.75, 0.75)), drive]);
                let rail = self.turn(rail, 2, angle);
                cart = self.shift(rail, vec![q(x), num(0.0)]);
                let body = self.body(Some(cart), None, None);
                self.guide(
                    body,
                    rail,
                    Vector::Along(rail, vec![num(1.0), num(0.0)]),
                    None,
                );
            }
            _ => {
                // A slope, and a body without a frame.
                let angle = num(self.random.number(-0.75, 0.75));
                let along = free(cos(angle.clone()), sin(angle.clone()));
                let at = Vector::Free(
                    vec![mul(q(x), cos(angle.clone())), mul(q(x), sin(angle))],
                    METRE,
                );
                let body = self.body(None, Some(at), None);
                self.guide(body, 0, along, None);
            }
        }
        if cart > 0 && self.random.chance(50) {
            // A block that slides on the first body.
            let s = self.coordinate();
            let slope = num(self.random.number(-0.5, 0.5));
            let slope = self.turn(cart, 2, slope);
            let block = self.shift(slope, vec![q(s), num(0.0)]);
            let body = self.body(Some(block), None, None);
            self.guide(
                body,
                slope,
                Vector::Along(slope, vec![num(1.0), num(0.0)]),
                None,
            );
            cart = if self.random.chance(50) { block } else { cart };
        }
        if cart > 0 && self.random.chance(50) {
            // A pendulum that hangs from the cart.
            let phi = self.coordinate();
            let rod = self.turn(cart, 2, q(phi));
            let at = Vector::Point(rod, vec![num(0.0), num(-self.random.number(0.5, 1.0))]);
            self.body(Some(rod), Some(at), None);
        }
        self.machine.gravity = Some(vec![num(0.0), num(-9.0)]);
        if self.random.chance(25) {
            // All coordinates are at rest relative to their guides, which may move.
            for coordinate in &mut self.machine.coordinates {
                coordinate.rate = 0.0;
            }
            for guide in &mut self.machine.sliding {
                guide.sticking = Some(num(3.0));
            }
        }
    }

    fn point(&mut self) -> Vector {
        let n = self.machine.bodies.len();
        let dimension = self.machine.dimension();
        match self.random.below(4) {
            0 => {
                let parts = (0..dimension).map(|_| num(self.random.number(-2.0, 2.0)));
                Vector::Free(parts.collect(), METRE)
            }
            1 if !self.machine.frames.is_empty() && self.machine.closed.is_none() => {
                let frame = 1 + self.random.below(self.machine.frames.len());
                let parts = (0..dimension).map(|_| num(self.random.number(-0.5, 0.5)));
                Vector::Point(frame, parts.collect())
            }
            _ => Vector::Centre(self.random.below(n)),
        }
    }

    fn value(&self, e: &Expr) -> f64 {
        let of = |f: fn(&Coordinate) -> f64| self.machine.coordinates.iter().map(f).collect();
        let state = State {
            t: 0.0,
            q: of(|c| c.start),
            v: of(|c| c.rate),
        };
        World::<f64>::new(&self.machine, &state).expr(e).value()
    }

    fn stretch(&mut self, kind: Kind) -> Stretch {
        // A stretch in terms of coordinates usually leaves its force across a guide undetermined, and such
        // machines are refused.
        let (tries, percent) = match kind {
            Kind::Guided => (4, 95),
            _ => (1, 60),
        };
        for _ in 0..tries {
            let (a, b) = (self.point(), self.point());
            if !self.random.chance(percent) {
                break;
            }
            let distance = self.value(&norm(a.clone().less(b.clone())));
            if distance > 0.25 && distance < 10.0 {
                let length = self.random.chance(70).then(|| self.positive());
                return Stretch::Points(a, b, length);
            }
        }
        let e = self.linear();
        Stretch::Number(e)
    }

    /// In the plane, sometimes a bushing between two frames. Machines with loops have none, because cutting a loop elsewhere
    /// rebuilds the frames.
    fn bushing(&mut self) {
        let count = self.machine.frames.len();
        let has_frames = count > 0 && !self.machine.spatial && self.machine.closed.is_none();
        if !has_frames || !self.random.chance(40) {
            return;
        }
        let (from, to) = (self.random.below(count + 1), 1 + self.random.below(count));
        if from == to {
            return;
        }
        let mut values =
            || [0, 1, 2].map(|_| mul(num(self.random.number(0.25, 4.0)), self.positive()));
        let (stiffness, damping, preload) = (values(), values(), values());
        let bushing = Bushing {
            from,
            to,
            stiffness,
            damping: self.random.chance(50).then_some(damping),
            preload: self.random.chance(50).then_some(preload),
        };
        self.machine.bushings.push(bushing);
    }

    fn linear(&mut self) -> Expr {
        let mut parts = vec![num(self.random.number(-1.0, 1.0))];
        for i in 0..self.machine.coordinates.len() {
            if self.random.chance(50) {
                parts.push(mul(self.factor(), q(i)));
            }
        }
        if self.random.chance(20) {
            let drive = self.drive();
            parts.push(drive);
        }
        if parts.len() == 1 {
            parts.push(q(self.any_coordinate()));
        }
        sum(parts)
    }

    /// Adds loads, constraints and outputs.
    fn act(&mut self, kind: Kind) {
        let dimension = self.machine.dimension();
        if self.machine.gravity.is_none() && self.random.chance(75) {
            let mut gravity: Vec<Expr> = (0..dimension)
                .map(|_| num(self.random.number(-9.0, 2.0)))
                .collect();
            match self.random.below(4) {
                0 => gravity[1] = neg(self.positive()),
                1 if self.random.chance(40) => {
                    let drive = self.drive();
                    gravity[0] = sum(vec![gravity[0].clone(), drive]);
                }
                _ => {}
            }
            self.machine.gravity = Some(gravity);
        }
        for k in 0..self.random.below(3) {
            let one = Elastic {
                name: format!("s{k}"),
                factor: mul(num(self.random.number(1.0, 8.0)), self.positive()),
                stretch: self.stretch(kind),
            };
            self.machine.springs.push(one);
        }
        for k in 0..self.random.below(2) {
            let one = Elastic {
                name: format!("z{k}"),
                factor: mul(num(self.random.number(0.25, 1.0)), self.positive()),
                stretch: match self.stretch(kind) {
                    Stretch::Points(a, b, _) => Stretch::Points(a, b, None),
                    stretch => stretch,
                },
            };
            self.machine.dampers.push(one);
        }
        if self.random.chance(25) {
            let (stiffness, twist) = (self.positive(), self.linear());
            self.machine.torsions.push((stiffness, twist));
        }
        self.bushing();
        if self.random.chance(25) {
            let (a, i, j) = (
                self.positive(),
                self.any_coordinate(),
                self.any_coordinate(),
            );
            let potential = match self.random.below(3) {
                0 => mul(a, cos(sum(vec![q(i), q(j)]))),
                1 => mul(a, Expr::Exp(Box::new(mul(num(-0.5), q(i))))),
                _ => mul(mul(num(0.25), a), power(q(i), 8)),
            };
            self.machine.potentials.push(potential);
        }
        if self.random.chance(25) {
            let (a, i, j) = (
                self.positive(),
                self.any_coordinate(),
                self.any_coordinate(),
            );
            let dissipation = match self.random.below(3) {
                0 => mul(mul(num(0.5), a), power(der(q(i)), 4)),
                1 => mul(mul(a, power(cos(q(j)), 4)), power(der(q(i)), 4)),
                _ => {
                    let body = self.random.below(self.machine.bodies.len());
                    let rate = Vector::Der(Box::new(Vector::Centre(body)));
                    // The root in the norm has no derivative if a body is at rest.
                    let speed = self.value(&norm(rate.clone()));
                    if speed > 0.125 {
                        mul(num(0.125), power(dot(rate.clone(), rate), 3))
                    } else {
                        mul(mul(num(0.5), a), power(der(q(i)), 4))
                    }
                }
            };
            self.machine.dissipations.push(dissipation);
        }
        for _ in 0..self.random.below(2) {
            let size = self.strength();
            let force = if self.random.chance(60) {
                let direction = (0..dimension).map(|_| num(self.random.number(-2.0, 2.0)));
                let parts = direction.map(|x| mul(size.clone(), x)).collect();
                Force::At(self.point(), Vector::Free(parts, NEWTON))
            } else {
                Force::On(self.any_coordinate(), size)
            };
            self.machine.forces.push(force);
        }
        if self.random.chance(30)
            && let Stretch::Points(from, to, _) = self.stretch(kind)
        {
            let size = self.strength();
            self.machine.forces.push(Force::Between(from, to, size));
        }
        let turning: Vec<usize> = (0..self.machine.bodies.len())
            .filter(|k| {
                let body = &self.machine.bodies[*k];
                body.frame.is_some() || body.angle.is_some()
            })
            .collect();
        if !turning.is_empty() && self.random.chance(25) {
            let body = turning[self.random.below(turning.len())];
            let count = if self.machine.spatial { 3 } else { 1 };
            let torque = (0..count).map(|_| self.strength()).collect();
            self.machine.torques.push((body, torque));
        }
        let n = self.machine.coordinates.len();
        if matches!(kind, Kind::Formulas | Kind::Tree) && n > 1 && self.random.chance(45) {
            for _ in 0..1 + self.random.below(n - 1) {
                self.constrain();
            }
        }
        self.observe();
        self.derive(kind);
    }

    /// The magnitude of a force or torque.
    fn strength(&mut self) -> Expr {
        let rate = der(q(self.any_coordinate()));
        match self.random.below(4) {
            0 if !self.machine.inputs.is_empty() => Expr::Input(0),
            1 => mul(self.positive(), cos(Expr::Time)),
            2 => mul(num(-0.5), rate),
            _ => self.positive(),
        }
    }

    fn constrain(&mut self) {
        let k = self.machine.constraints.len();
        let (i, j) = (self.any_coordinate(), self.any_coordinate());
        let bodies = self.machine.bodies.len();
        let (a, b) = (self.random.below(bodies), self.random.below(bodies));
        let dimension = self.machine.dimension();
        let line = Vector::Centre(a).less(Vector::Centre(b));
        let rounded = |x: f64| num((x * 64.0).round() / 64.0);
        let (left, right, holonomic) = match self.random.below(9) {
            7 | 8 if self.machine.frames.len() > 1 => {
                // The distance from the parent of a frame: some coordinates drop out of it, but only after sums of
                // parameters are expanded.
                let frame = 1 + self.random.below(self.machine.frames.len());
                let parent = self.machine.frames[frame - 1].parent;
                let before = match parent {
                    0 => 0,
                    _ => self.machine.frames[parent - 1].parent,
                };
                let local = (0..dimension).map(|_| {
                    if self.random.chance(50) {
                        self.positive()
                    } else {
                        num(0.0)
                    }
                });
                let line = Vector::Point(frame, local.collect()).less(Vector::Origin(before));
                let distance = self.value(&norm(line.clone()));
                if distance < 0.25 {
                    return;
                }
                (dot(line.clone(), line), power(rounded(distance), 4), true)
            }
            0 | 1 if i != j => {
                // A coordinate as a function of others.
                let right = match self.random.below(4) {
                    0 => sum(vec![mul(self.factor(), q(j)), self.positive()]),
                    1 => quotient(power(q(j), 4), num(2.0)),
                    2 => mul(self.positive(), sin(q(j))),
                    _ => mul(self.factor(), q(j)),
                };
                (q(i), right, true)
            }
            2 if a != b => {
                let distance = self.value(&norm(line.clone()));
                if distance < 0.25 {
                    return;
                }
                let length = rounded(distance);
                if self.random.chance(50) {
                    (norm(line), length, true)
                } else {
                    (dot(line.clone(), line), power(length, 4), true)
                }
            }
            3 if a != b => {
                let mut direction = vec![num(0.0); dimension];
                direction[self.random.below(dimension)] = num(1.0);
                let along = dot(line, Vector::Free(direction, PURE));
                let height = rounded(self.value(&along));
                (along, height, true)
            }
            4 if i != j => (der(q(i)), mul(self.factor(), der(q(j))), false),
            5 if i != j => {
                let l = self.any_coordinate();
                let left = mul(sin(q(l)), der(q(i)));
                let right = mul(cos(q(l)), der(q(j)));
                (left, right, false)
            }
            _ if i != j => {
                let left = sum(vec![q(i), mul(self.factor(), q(j))]);
                let mut right = vec![rounded(self.value(&left))];
                if self.random.chance(30) {
                    let drive = self.drive();
                    right.push(drive);
                }
                (left, sum(right), true)
            }
            _ => return,
        };
        self.machine.constraints.push(Constraint {
            name: format!("h{k}"),
            left,
            right,
            holonomic,
        });
    }

    fn observe(&mut self) {
        for _ in 0..self.random.below(3) {
            let body = self.random.below(self.machine.bodies.len());
            let centre = Box::new(Vector::Centre(body));
            let i = self.any_coordinate();
            let output = match self.random.below(4) {
                0 => mul(self.positive(), der(der(q(i)))),
                1 => {
                    let rate = Vector::Der(centre);
                    dot(rate.clone(), rate)
                }
                2 => {
                    let parts =
                        (0..self.machine.dimension()).map(|_| num(self.random.number(-1.0, 1.0)));
                    let direction = Vector::Free(parts.collect(), PURE);
                    dot(Vector::Der(Box::new(Vector::Der(centre))), direction)
                }
                _ => mul(sin(q(i)), der(q(self.any_coordinate()))),
            };
            self.machine.outputs.push(output);
        }
    }

    /// Adds definitions, assumptions, approximations, derivatives and stages.
    fn derive(&mut self, kind: Kind) {
        if self.random.chance(25) {
            // The position of a body gets a name.
            let body = self.random.below(self.machine.bodies.len());
            if let Some(at) = self.machine.bodies[body].at.take() {
                let k = self.machine.defines.len();
                self.machine.defines.push(Meaning::Vector(at));
                self.machine.bodies[body].at = Some(Vector::Define(k));
            }
        }
        if self.random.chance(25) && !self.machine.springs.is_empty() {
            let k = self.machine.defines.len();
            let factor = &mut self.machine.springs[0].factor;
            let meaning = std::mem::replace(factor, Expr::Define(k));
            self.machine.defines.push(Meaning::Number(meaning));
        }
        if self.random.chance(25) {
            let positive = Expr::Parameter(self.random.below(self.machine.parameters.len()));
            self.machine.assumptions.push(positive);
        }
        if self.random.chance(15) {
            let i = self.any_coordinate();
            self.machine.coordinates[i].kept = [self.random.chance(60), self.random.chance(60)];
        }
        if kind == Kind::Guided {
            return;
        }
        if matches!(kind, Kind::Formulas | Kind::Tree)
            && !self.machine.spatial
            && self.machine.constraints.is_empty()
            && self.random.chance(12)
        {
            let i = self.any_coordinate();
            let kind = if self.random.chance(50) {
                Approximation::Frozen
            } else {
                Approximation::Small
            };
            if kind == Approximation::Small {
                // Far from the point of expansion the kinetic energy need not be positive.
                let coordinate = &mut self.machine.coordinates[i];
                coordinate.start /= 16.0;
            }
            self.machine.approximations.push((i, kind));
        }
        if self.random.chance(20) {
            let parts = [0, 1, 2, 3].map(|_| self.random.chance(50));
            self.machine.derivatives = parts;
            self.machine.derivatives[2] &= !self.machine.inputs.is_empty();
        }
        if self.random.chance(15) {
            let time = self.random.chance(60);
            self.machine.stages = [time, !time || self.random.chance(60)];
        }
    }
}

/// A chain whose links are families: the machine with its members one by one, and the text that uses families.
pub fn chain(random: &mut Random) -> (Machine, String) {
    let n = 2 + random.below(3);
    let mut machine = Machine::default();
    let mut values = Vec::new();
    for (name, low, high) in [("a0", 0.5, 1.5), ("a1", 1.0, 4.0)] {
        let value = random.number(low, high);
        values.push(value);
        let name = name.into();
        machine.parameters.push(Value { name, value });
    }
    let [a0, a1] = [0, 1].map(Expr::Parameter);
    let (more, held, twist) = (
        random.number(0.25, 1.0),
        random.chance(50),
        random.number(0.5, 2.0),
    );
    let drag = random.number(0.25, 1.0);
    for i in 1..=n {
        machine.coordinates.push(Coordinate {
            name: format!("x{i}"),
            start: random.number(-1.5, 1.5),
            rate: random.number(-1.5, 1.5),
            kept: [false; 2],
        });
        let link = machine.frames.len();
        let step = Step::Turn(2, q(i - 1));
        machine.frames.push(Frame { parent: link, step });
        let step = Step::Shift(vec![a0.clone(), num(0.0)]);
        machine.frames.push(Frame {
            parent: link + 1,
            step,
        });
        machine.bodies.push(Body {
            name: format!("b{i}"),
            mass: sum(vec![a0.clone(), num(more * i as f64)]),
            inertia: Vec::new(),
            frame: None,
            at: Some(Vector::Origin(link + 2)),
            angle: None,
        });
        let before = i.checked_sub(2);
        if let Some(before) = before {
            machine.springs.push(Elastic {
                name: format!("s{i}"),
                factor: a1.clone(),
                stretch: Stretch::Points(
                    Vector::Centre(before),
                    Vector::Centre(i - 1),
                    Some(num(0.5)),
                ),
            });
            let relative = sum(vec![q(i - 1), neg(q(before))]);
            machine
                .torsions
                .push((mul(num(twist), a1.clone()), relative));
        }
        machine
            .dissipations
            .push(mul(num(drag), power(der(q(i - 1)), 4)));
        machine.outputs.push(mul(num(i as f64), der(der(q(i - 1)))));
    }
    if held {
        machine.constraints.push(Constraint {
            name: "h".into(),
            left: sum(vec![q(0), q(n - 1)]),
            right: sum(vec![num(0.5), mul(num(0.25), sin(Expr::Time))]),
            holonomic: true,
        });
    }
    machine.gravity = Some(vec![num(0.5), num(-9.0)]);
    let hold = if held {
        "constraints { h: q[1] + q[N] = 0.5 + 0.25*sin(t/one_s) }"
    } else {
        ""
    };
    let text = format!(
        "machine Chain in plane {{
    constants {{ one_m: m = 1, one_s: s = 1, one_kg: kg = 1, one_N: N = 1, N = {n} }}
    parameters {{ a[i in 0..1]: 1 = (1 - i)*{} + i*{} }}
    coordinates {{ q[1..N]: 1 = 0.25 }}
    frames {{ link[0] = ground, link[i in 1..N] = link[i-1].turn(q[i]).shift(a[0]*one_m, 0) }}
    bodies {{ bob[i in 1..N] {{ mass: one_kg*(a[0] + {more}*i), at: link[i].origin }} }}
    gravity (0.5*one_m/one_s^2, -9*one_m/one_s^2);
    springs {{ s[i in 2..N] {{ stiffness: a[1]*one_N/one_m, from: bob[i-1].at, to: bob[i].at, length: 0.5*one_m }} }}
    torsion_springs {{ w[i in 2..N] {{ stiffness: {twist}*a[1]*one_N*one_m, twist: q[i] - q[i-1] }} }}
    dissipations {{ r[i in 1..N]: {drag}*one_N*one_m*one_s*der(q[i])^2 }}
    outputs {{ o[i in 1..N]: 1/s^2 = i*der(der(q[i])) }}
    {hold}
}}
",
        values[0], values[1]
    );
    (machine, text)
}

/// Builds the frames and constraints of a closed loop of links, cut after link `cut`.
///
/// Link k goes from its start to its end at the angle of coordinate k. The links up to the cut are built forward from the ground, those
/// after it backward from the anchor. The first frame of a link has its origin at its start and contains the position of its body.
pub fn close(machine: &mut Machine) {
    let closed = machine.closed.clone().expect("the links close");
    let links = closed.lengths.len();
    let first_time = machine.frames.is_empty();
    let mut frames = Vec::new();
    // Frames 1 and 2 carry the two ends. Each link has two: one for its axes, and one for its other end.
    let mut add = |parent: usize, step: Step| {
        frames.push(Frame { parent, step });
        frames.len()
    };
    let mut of_link = vec![0; links];
    let mut end = [0, add(0, Step::Shift(closed.anchor.to_vec()))];
    let mut last: [Option<usize>; 2] = [None, None];
    let order = (0..closed.cut).chain((closed.cut..links).rev());
    for k in order {
        let side = usize::from(k >= closed.cut);
        let angle = match last[side] {
            Some(before) => sum(vec![q(k), neg(q(before))]),
            None => q(k),
        };
        last[side] = Some(k);
        let axes = add(end[side], Step::Turn(2, angle));
        let length = &closed.lengths[k];
        let shifted = match side {
            0 => length.clone(),
            _ => neg(length.clone()),
        };
        let other = add(axes, Step::Shift(vec![shifted, num(0.0)]));
        end[side] = other;
        of_link[k] = if side == 0 { axes } else { other };
    }
    let renamed: Vec<(usize, usize)> = machine
        .bodies
        .iter()
        .take(links)
        .map(|body| body.frame.unwrap_or(0))
        .zip(of_link.iter().copied())
        .collect();
    machine.frames = frames;
    // Everything that was written in the frame of a link moves to its new frame.
    if first_time {
        for (k, frame) in of_link.iter().enumerate() {
            let body = &mut machine.bodies[k];
            body.frame = Some(*frame);
            if let Some(Vector::Point(at, _)) = &mut body.at {
                *at = *frame;
            }
        }
    } else {
        machine.all_vectors(&mut |v| {
            if let Vector::Point(frame, _) | Vector::Along(frame, _) | Vector::Origin(frame) = v {
                let new = renamed.iter().find(|(old, _)| old == frame);
                *frame = new.map_or(*frame, |(_, new)| *new);
            }
        });
        for (k, frame) in of_link.iter().enumerate() {
            machine.bodies[k].frame = Some(*frame);
        }
    }
    let apart = |axis: [f64; 2]| {
        let line = Vector::Origin(end[0]).less(Vector::Origin(end[1]));
        dot(
            line,
            Vector::Free(axis.iter().map(|x| num(*x)).collect(), PURE),
        )
    };
    for (name, axis) in [("across", [1.0, 0.0]), ("up", [0.0, 1.0])] {
        let left = apart(axis);
        match machine.constraints.iter_mut().find(|one| one.name == name) {
            Some(one) => one.left = left,
            None => machine.constraints.push(Constraint {
                name: name.into(),
                left,
                right: num(0.0),
                holonomic: true,
            }),
        }
    }
}
