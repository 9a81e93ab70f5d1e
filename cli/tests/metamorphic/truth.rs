//! The motion of a machine, computed numerically from the machine as a value.
//!
//! Positions are evaluated and differentiated with [`Jet`]s: velocities along the motion, Lagrange's equations from T, V and D
//! as written, constraints from their rates, and the reactions of guides from virtual displacements that release them. Then one
//! linear system is solved. Nothing here is shared with the compiler but the arithmetic of double-doubles.

use lagrangian_scalar::Scalar;

use super::jet::{Jet, solve};
use super::machine::{
    Approximation, Bushing, Expr, Force, Machine, Meaning, Step, Stretch, Surface, Vector,
};

/// A state: time, coordinates, rates; and inputs.
#[derive(Clone, Debug)]
pub struct State<S> {
    pub t: S,
    pub q: Vec<S>,
    pub v: Vec<S>,
}

/// A variable with respect to which the accelerations are differentiated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Variable {
    Coordinate(usize),
    Rate(usize),
    Input(usize),
    Parameter(usize),
}

#[derive(Clone)]
struct Pose<S> {
    origin: Vec<Jet<S>>,
    /// Component i of axis k at `axes[i][k]`.
    axes: Vec<Vec<Jet<S>>>,
    /// In the plane, the angle of rotation.
    angle: Jet<S>,
}

/// Everything that the evaluation of expressions needs.
#[derive(Clone)]
pub struct World<'m, S> {
    machine: &'m Machine,
    t: Jet<S>,
    /// The coordinates, followed by two displacements for each guide, which are 0.
    q: Vec<Jet<S>>,
    v: Vec<Jet<S>>,
    a: Vec<Jet<S>>,
    inputs: Vec<Jet<S>>,
    parameters: Vec<Jet<S>>,
    /// The number of infinitesimals in use.
    bits: usize,
    /// Whether velocities are approximated.
    frozen: bool,
    /// The values of the coordinates within sines and cosines.
    in_angles: Option<Vec<Jet<S>>>,
    poses: Vec<Pose<S>>,
}

/// M, f and the other terms at a state; everything may depend on the infinitesimal of a variable.
pub struct Equations<S> {
    pub mass: Vec<Vec<Jet<S>>>,
    pub bias: Vec<Jet<S>>,
    pub applied: Vec<Jet<S>>,
    pub rows: Vec<Vec<Jet<S>>>,
    pub constraint_bias: Vec<Jet<S>>,
    /// For each guide ∂w/∂v, and dw/dt at zero accelerations.
    slips: Vec<(Vec<Jet<S>>, Jet<S>)>,
}

/// A contact.
#[derive(Clone, Copy, Debug)]
pub struct Contact<S> {
    pub slip: S,
    pub normal: S,
    pub friction: S,
}

/// The results that are compared.
pub struct Truth<S> {
    pub mass: Vec<Vec<S>>,
    pub bias: Vec<S>,
    pub applied: Vec<S>,
    pub accelerations: Vec<S>,
    pub multipliers: Vec<S>,
    pub contacts: Vec<Contact<S>>,
    pub kinetic: S,
    pub potential: S,
    pub dissipation: S,
    pub outputs: Vec<S>,
    /// The ratio of the smallest pivot to the largest, in the system that was solved.
    pub pivot: f64,
    /// The largest number in the system and its solution.
    pub size: f64,
}

fn plus<S: Scalar>(a: &[Jet<S>], b: &[Jet<S>]) -> Vec<Jet<S>> {
    a.iter().zip(b).map(|(a, b)| a.add(b)).collect()
}

fn minus<S: Scalar>(a: &[Jet<S>], b: &[Jet<S>]) -> Vec<Jet<S>> {
    a.iter().zip(b).map(|(a, b)| a.sub(b)).collect()
}

fn product<S: Scalar>(a: &[Jet<S>], b: &[Jet<S>]) -> Jet<S> {
    let parts = a.iter().zip(b).map(|(a, b)| a.mul(b));
    parts.fold(Jet::of(S::ZERO), |sum, part| sum.add(&part))
}

impl<'m, S: Scalar> World<'m, S> {
    pub fn new(machine: &'m Machine, state: &State<S>) -> Self {
        let jets = |values: &[S]| -> Vec<Jet<S>> { values.iter().map(|x| Jet::of(*x)).collect() };
        let numbers = |values: &[super::machine::Value]| -> Vec<Jet<S>> {
            values.iter().map(|x| Jet::number(x.value)).collect()
        };
        let mut world = World {
            machine,
            t: Jet::of(state.t),
            q: jets(&state.q),
            v: jets(&state.v),
            a: jets(&vec![S::ZERO; state.q.len()]),
            inputs: numbers(&machine.inputs),
            parameters: numbers(&machine.parameters),
            bits: 0,
            frozen: false,
            in_angles: None,
            poses: Vec::new(),
        };
        for list in [&mut world.q, &mut world.v, &mut world.a] {
            list.extend((0..2 * machine.sliding.len()).map(|_| Jet::of(S::ZERO)));
        }
        world.place();
        world
    }

    /// Evaluates the poses of the frames.
    fn place(&mut self) {
        let n = self.machine.dimension();
        let one = |i: usize, k: usize| Jet::of(if i == k { S::ONE } else { S::ZERO });
        self.poses = vec![Pose {
            origin: vec![Jet::of(S::ZERO); n],
            axes: (0..n)
                .map(|i| (0..n).map(|k| one(i, k)).collect())
                .collect(),
            angle: Jet::of(S::ZERO),
        }];
        for (index, frame) in self.machine.frames.iter().enumerate() {
            let mut pose = self.poses[frame.parent].clone();
            match &frame.step {
                Step::Shift(shift) => pose.origin = self.point(frame.parent, shift),
                Step::Turn(axis, angle) => {
                    let (sin, cos) = self.angle(angle).sin_cos();
                    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                    for row in &mut pose.axes {
                        let (x, y) = (row[a].clone(), row[b].clone());
                        row[a] = x.mul(&cos).add(&y.mul(&sin));
                        row[b] = y.mul(&cos).sub(&x.mul(&sin));
                    }
                    pose.angle = pose.angle.add(&self.expr(angle));
                }
            }
            for (k, guide) in self.machine.sliding.iter().enumerate() {
                if self.machine.bodies[guide.body].frame == Some(index + 1) {
                    pose.origin = plus(&pose.origin, self.displacement(k));
                }
            }
            self.poses.push(pose);
        }
    }

    fn displacement(&self, guide: usize) -> &[Jet<S>] {
        let n = self.machine.coordinates.len();
        &self.q[n + 2 * guide..][..2]
    }

    /// A copy of this world with a change.
    fn with(&self, change: impl FnOnce(&mut Self)) -> Self {
        let mut world = self.clone();
        change(&mut world);
        world.place();
        world
    }

    /// The time derivatives of numbers along the motion.
    fn rates(&self, f: impl Fn(&Self) -> Vec<Jet<S>>) -> Vec<Jet<S>> {
        let small = Jet::infinitesimal(self.bits);
        let moved = self.with(|world| {
            world.bits += 1;
            world.t = self.t.add(&small);
            for (i, (v, a)) in self.v.iter().zip(&self.a).enumerate() {
                world.q[i] = self.q[i].add(&small.mul(v));
                world.v[i] = v.add(&small.mul(a));
            }
            if self.frozen {
                let mut in_angles = world.q.clone();
                for (i, _) in frozen(self.machine) {
                    in_angles[i] = small.mul(&self.v[i]);
                }
                world.in_angles = Some(in_angles);
            }
        });
        f(&moved).iter().map(|x| x.part(self.bits)).collect()
    }

    fn rate(&self, f: impl Fn(&Self) -> Jet<S>) -> Jet<S> {
        self.rates(|world| vec![f(world)]).remove(0)
    }

    /// The argument of a sine or cosine.
    fn angle(&self, e: &Expr) -> Jet<S> {
        match &self.in_angles {
            None => self.expr(e),
            Some(in_angles) => {
                let mut world = self.clone();
                world.q.clone_from(in_angles);
                world.expr(e)
            }
        }
    }

    pub fn expr(&self, e: &Expr) -> Jet<S> {
        match e {
            Expr::Number(x) => Jet::number(*x),
            Expr::Parameter(k) => self.parameters[*k].clone(),
            Expr::Constant(k) => Jet::number(self.machine.constants[*k].value),
            Expr::Define(k) => match &self.machine.defines[*k] {
                Meaning::Number(e) => self.expr(e),
                Meaning::Vector(_) => unreachable!("a definition of a number"),
            },
            Expr::Coordinate(i) => self.q[*i].clone(),
            Expr::Input(k) => self.inputs[*k].clone(),
            Expr::Time => self.t.clone(),
            Expr::Sum(parts) => parts
                .iter()
                .fold(Jet::of(S::ZERO), |sum, part| sum.add(&self.expr(part))),
            Expr::Product(parts) => parts.iter().fold(Jet::of(S::ONE), |product, part| {
                product.mul(&self.expr(part))
            }),
            Expr::Quotient(a, b) => self.expr(a).div(&self.expr(b)),
            Expr::Power(a, halves) => self.expr(a).power(*halves),
            Expr::Sin(a) => self.angle(a).sin_cos().0,
            Expr::Cos(a) => self.angle(a).sin_cos().1,
            Expr::Exp(a) => self.expr(a).exp(),
            Expr::Angle(y, x) => Jet::angle(&self.expr(y), &self.expr(x)),
            Expr::Der(a) => self.rate(|world| world.expr(a)),
            Expr::Dot(u, v) => product(&self.vector(u), &self.vector(v)),
            Expr::Norm(u) => {
                let u = self.vector(u);
                product(&u, &u).sqrt()
            }
        }
    }

    fn exprs(&self, list: &[Expr]) -> Vec<Jet<S>> {
        list.iter().map(|e| self.expr(e)).collect()
    }

    fn along(&self, frame: usize, local: &[Expr]) -> Vec<Jet<S>> {
        let local = self.exprs(local);
        let axes = &self.poses[frame].axes;
        axes.iter().map(|row| product(row, &local)).collect()
    }

    fn point(&self, frame: usize, local: &[Expr]) -> Vec<Jet<S>> {
        plus(&self.poses[frame].origin, &self.along(frame, local))
    }

    pub fn vector(&self, v: &Vector) -> Vec<Jet<S>> {
        match v {
            Vector::Free(parts, _) => self.exprs(parts),
            Vector::Origin(frame) => self.poses[*frame].origin.clone(),
            Vector::Point(frame, local) => self.point(*frame, local),
            Vector::Along(frame, local) => self.along(*frame, local),
            Vector::Centre(body) => self.centre(*body),
            Vector::Define(k) => match &self.machine.defines[*k] {
                Meaning::Vector(v) => self.vector(v),
                Meaning::Number(_) => unreachable!("a definition of a vector"),
            },
            Vector::Less(a, b) => minus(&self.vector(a), &self.vector(b)),
            Vector::Scaled(e, a) => {
                let factor = self.expr(e);
                self.vector(a).iter().map(|x| x.mul(&factor)).collect()
            }
            Vector::Der(a) => self.rates(|world| world.vector(a)),
        }
    }

    fn centre(&self, body: usize) -> Vec<Jet<S>> {
        let one = &self.machine.bodies[body];
        let mut centre = match (&one.at, one.frame) {
            (Some(at), _) => self.vector(at),
            (None, Some(frame)) => self.poses[frame].origin.clone(),
            (None, None) => unreachable!("every body is somewhere"),
        };
        for (k, guide) in self.machine.sliding.iter().enumerate() {
            if guide.body == body && one.frame.is_none() {
                centre = plus(&centre, self.displacement(k));
            }
        }
        centre
    }

    fn turned(&self, body: usize) -> Jet<S> {
        let one = &self.machine.bodies[body];
        match (&one.angle, one.frame) {
            (Some(angle), _) => self.expr(angle),
            (None, Some(frame)) => self.poses[frame].angle.clone(),
            (None, None) => Jet::of(S::ZERO),
        }
    }

    /// The angular velocity of a frame, in its own axes, from its axes and their rates.
    fn spin(axes: &[Vec<Jet<S>>], rates: &[Jet<S>]) -> Vec<Jet<S>> {
        // (RᵀṘ)_ba is component c for (a, b, c) cyclic.
        let column = |k: usize| -> Vec<Jet<S>> { axes.iter().map(|row| row[k].clone()).collect() };
        let rate = |k: usize| -> Vec<Jet<S>> { (0..3).map(|i| rates[3 * i + k].clone()).collect() };
        (0..3)
            .map(|c| product(&column((c + 2) % 3), &rate((c + 1) % 3)))
            .collect()
    }

    fn flat_axes(&self, frame: usize) -> Vec<Jet<S>> {
        self.poses[frame].axes.iter().flatten().cloned().collect()
    }

    /// T of the velocities without approximation.
    fn kinetic_exact(&self) -> Jet<S> {
        let machine = self.machine;
        let mut twice = Jet::of(S::ZERO);
        for (k, body) in machine.bodies.iter().enumerate() {
            let rate = self.rates(|world| world.centre(k));
            let mass = self.expr(&body.mass);
            twice = twice.add(&mass.mul(&product(&rate, &rate)));
            if body.inertia.is_empty() {
                continue;
            }
            let inertia = self.exprs(&body.inertia);
            if !machine.spatial {
                let rate = self.rate(|world| world.turned(k));
                twice = twice.add(&inertia[0].mul(&rate).mul(&rate));
                continue;
            }
            let frame = body.frame.expect("a solid in space has a frame");
            let rates = self.rates(|world| world.flat_axes(frame));
            let omega = Self::spin(&self.poses[frame].axes, &rates);
            for i in 0..3 {
                twice = twice.add(&inertia[i].mul(&omega[i]).mul(&omega[i]));
            }
            for (entry, (i, j)) in inertia.iter().skip(3).zip([(0, 1), (0, 2), (1, 2)]) {
                twice = twice.add(&entry.mul(&omega[i]).mul(&omega[j]).times(2.0));
            }
        }
        twice.times(0.5)
    }

    fn stretch(&self, stretch: &Stretch) -> Jet<S> {
        match stretch {
            Stretch::Number(e) => self.expr(e),
            Stretch::Points(a, b, length) => {
                let distance = self.distance(a, b);
                match length {
                    Some(length) => distance.sub(&self.expr(length)),
                    None => distance,
                }
            }
        }
    }

    fn distance(&self, a: &Vector, b: &Vector) -> Jet<S> {
        let line = minus(&self.vector(b), &self.vector(a));
        product(&line, &line).sqrt()
    }

    /// The deformation of a bushing: the position of one frame's origin along the axes of the other, and the relative rotation.
    fn deformation(&self, bushing: &Bushing) -> Vec<Jet<S>> {
        let [from, to] = [bushing.from, bushing.to].map(|frame| &self.poses[frame]);
        let line = minus(&to.origin, &from.origin);
        let along = |k: usize| {
            let axis: Vec<Jet<S>> = from.axes.iter().map(|row| row[k].clone()).collect();
            product(&axis, &line)
        };
        vec![along(0), along(1), to.angle.sub(&from.angle)]
    }

    fn potential_exact(&self) -> Jet<S> {
        let machine = self.machine;
        let mut sum = Jet::of(S::ZERO);
        let elastic = |factor: &Expr, s: Jet<S>| self.expr(factor).mul(&s).mul(&s).times(0.5);
        for spring in &machine.springs {
            sum = sum.add(&elastic(&spring.factor, self.stretch(&spring.stretch)));
        }
        for (stiffness, twist) in &machine.torsions {
            sum = sum.add(&elastic(stiffness, self.expr(twist)));
        }
        for bushing in &machine.bushings {
            let deformed = self.deformation(bushing);
            for (factor, s) in bushing.stiffness.iter().zip(&deformed) {
                sum = sum.add(&elastic(factor, s.clone()));
            }
            let preload = bushing.preload.iter().flatten().zip(&deformed);
            for (force, s) in preload {
                sum = sum.sub(&self.expr(force).mul(s));
            }
        }
        for potential in &machine.potentials {
            sum = sum.add(&self.expr(potential));
        }
        if let Some(gravity) = &machine.gravity {
            let gravity = self.exprs(gravity);
            for (k, body) in machine.bodies.iter().enumerate() {
                let work = product(&gravity, &self.centre(k));
                sum = sum.sub(&self.expr(&body.mass).mul(&work));
            }
        }
        sum
    }

    fn dissipation_exact(&self) -> Jet<S> {
        let mut sum = Jet::of(S::ZERO);
        for damper in &self.machine.dampers {
            let rate = self.rate(|world| world.stretch(&damper.stretch));
            sum = sum.add(&self.expr(&damper.factor).mul(&rate).mul(&rate).times(0.5));
        }
        for bushing in &self.machine.bushings {
            let rates = self.rates(|world| world.deformation(bushing));
            for (factor, rate) in bushing.damping.iter().flatten().zip(rates) {
                sum = sum.add(&self.expr(factor).mul(&rate).mul(&rate).times(0.5));
            }
        }
        for one in &self.machine.dissipations {
            sum = sum.add(&self.expr(one));
        }
        sum
    }

    /// An energy expanded to second order in the small coordinates: f₀ + f₁ + ½ f₂ of f(η) with η = ε + ε'.
    fn expanded(&self, f: impl Fn(&Self) -> Jet<S>) -> Jet<S> {
        if small(self.machine).next().is_none() {
            return f(self);
        }
        let bits = self.bits;
        let eta = Jet::infinitesimal(bits).add(&Jet::infinitesimal(bits + 1));
        let value = f(&self.with(|world| {
            world.bits += 2;
            for (i, _) in small(self.machine) {
                world.q[i] = self.q[i].mul(&eta);
                world.v[i] = self.v[i].mul(&eta);
            }
        }));
        let (without, second) = (value.without(bits + 1), value.part(bits + 1).part(bits));
        without
            .without(bits)
            .add(&without.part(bits))
            .add(&second.times(0.5))
    }

    pub fn kinetic(&self) -> Jet<S> {
        self.expanded(|world| {
            let mut world = world.clone();
            world.frozen = frozen(self.machine).next().is_some();
            world.kinetic_exact()
        })
    }

    pub fn potential(&self) -> Jet<S> {
        self.expanded(World::potential_exact)
    }

    pub fn dissipation(&self) -> Jet<S> {
        self.expanded(World::dissipation_exact)
    }

    /// The derivative of numbers with respect to a coordinate.
    fn by_coordinate(&self, i: usize, f: impl Fn(&Self) -> Vec<Jet<S>>) -> Vec<Jet<S>> {
        let small = Jet::infinitesimal(self.bits);
        let moved = self.with(|world| {
            world.bits += 1;
            world.q[i] = self.q[i].add(&small);
        });
        f(&moved).iter().map(|x| x.part(self.bits)).collect()
    }

    fn by_rate(&self, i: usize, f: impl Fn(&Self) -> Vec<Jet<S>>) -> Vec<Jet<S>> {
        let mut moved = self.clone();
        moved.bits += 1;
        moved.v[i] = self.v[i].add(&Jet::infinitesimal(self.bits));
        f(&moved).iter().map(|x| x.part(self.bits)).collect()
    }

    /// The residuals of the constraints, each with a flag that says whether it is holonomic.
    pub fn constraints(&self) -> Vec<(Jet<S>, bool)> {
        let machine = self.machine;
        let mut list: Vec<(Jet<S>, bool)> = machine
            .constraints
            .iter()
            .map(|one| {
                (
                    self.expr(&one.left).sub(&self.expr(&one.right)),
                    one.holonomic,
                )
            })
            .collect();
        for rolling in &machine.rolling {
            let (gap, slip) = self.touching(rolling.circle, &rolling.surface);
            list.extend([(gap, true), (slip, false)]);
        }
        list
    }

    fn circle(&self, circle: usize) -> Vec<Jet<S>> {
        let circle = &self.machine.circles[circle];
        match circle.on {
            Ok(frame) => self.point(frame, &circle.centre),
            Err(body) => {
                let local = self.exprs(&circle.centre);
                let (sin, cos) = self.turned(body).sin_cos();
                let turned = [
                    local[0].mul(&cos).sub(&local[1].mul(&sin)),
                    local[0].mul(&sin).add(&local[1].mul(&cos)),
                ];
                plus(&self.centre(body), &turned)
            }
        }
    }

    fn turning(&self, circle: usize) -> Jet<S> {
        match self.machine.circles[circle].on {
            Ok(frame) => self.rate(|world| world.poses[frame].angle.clone()),
            Err(body) => self.rate(|world| world.turned(body)),
        }
    }

    /// The distance between a circle and the surface on which it rolls, and the slip velocity: the difference of the velocities
    /// of the two touching points, which are fixed to their bodies.
    fn touching(&self, circle: usize, surface: &Surface) -> (Jet<S>, Jet<S>) {
        let radius = self.expr(&self.machine.circles[circle].radius);
        let velocity = self.rates(|world| world.circle(circle));
        let left = |e: &[Jet<S>]| vec![e[1].neg(), e[0].clone()];
        let scaled =
            |e: &[Jet<S>], x: &Jet<S>| -> Vec<Jet<S>> { e.iter().map(|e| e.mul(x)).collect() };
        // The velocity of the point at `from` relative to a centre that moves with `velocity`.
        let point = |velocity: &[Jet<S>], omega: &Jet<S>, from: &[Jet<S>]| {
            plus(velocity, &scaled(&left(from), omega))
        };
        let omega = self.turning(circle);
        match surface {
            Surface::Along(frame) => {
                let pose = &self.poses[*frame];
                let [e, n] = [0, 1].map(|k| -> Vec<Jet<S>> {
                    pose.axes.iter().map(|row| row[k].clone()).collect()
                });
                let line = minus(&self.circle(circle), &pose.origin);
                let own = point(&velocity, &omega, &scaled(&n, &radius.neg()));
                let of_frame = self.rates(|world| world.poses[*frame].origin.clone());
                let turning = self.rate(|world| world.poses[*frame].angle.clone());
                let foot = scaled(&e, &product(&e, &line));
                let other = point(&of_frame, &turning, &foot);
                let slip = product(&e, &minus(&own, &other));
                (product(&n, &line).sub(&radius), slip)
            }
            Surface::Inside(other) | Surface::Outside(other) => {
                let of_other = self.expr(&self.machine.circles[*other].radius);
                let line = minus(&self.circle(circle), &self.circle(*other));
                let distance = product(&line, &line).sqrt();
                let e = scaled(&line, &distance.power(-2));
                let inside = matches!(surface, Surface::Inside(_));
                let own_side = if inside { radius.clone() } else { radius.neg() };
                let own = point(&velocity, &omega, &scaled(&e, &own_side));
                let velocity = self.rates(|world| world.circle(*other));
                let there = point(&velocity, &self.turning(*other), &scaled(&e, &of_other));
                let slip = product(&left(&e), &minus(&own, &there));
                let gap = if inside {
                    of_other.sub(&radius).sub(&distance)
                } else {
                    distance.sub(&radius).sub(&of_other)
                };
                (gap, slip)
            }
        }
    }

    /// The velocity of a body in a guide relative to the body on which it slides, in ground axes.
    fn relative(&self, guide: usize) -> Vec<Jet<S>> {
        let guide = &self.machine.sliding[guide];
        let seen = |world: &Self| -> Vec<Jet<S>> {
            let point = match world.machine.bodies[guide.body].frame {
                Some(frame) => world.poses[frame].origin.clone(),
                None => world.centre(guide.body),
            };
            let pose = &world.poses[guide.on];
            let line = minus(&point, &pose.origin);
            (0..2)
                .map(|k| {
                    let axis: Vec<Jet<S>> = pose.axes.iter().map(|row| row[k].clone()).collect();
                    product(&axis, &line)
                })
                .collect()
        };
        let rates = self.rates(seen);
        let axes = &self.poses[guide.on].axes;
        axes.iter().map(|row| product(row, &rates)).collect()
    }

    /// Unit vectors along a guide, and in the direction of a positive normal reaction.
    fn directions(&self, guide: usize) -> [Vec<Jet<S>>; 2] {
        let guide = &self.machine.sliding[guide];
        let unit = |v: Vec<Jet<S>>| -> Vec<Jet<S>> {
            let over = product(&v, &v).power(-1);
            v.iter().map(|x| x.mul(&over)).collect()
        };
        let e = unit(self.vector(&guide.direction));
        let mut n = vec![e[1].neg(), e[0].clone()];
        if let Some(normal) = &guide.normal
            && !product(&self.vector(normal), &n).value().exceeds(S::ZERO)
        {
            n = n.iter().map(Jet::neg).collect();
        }
        [e, n]
    }

    /// Lagrange's equations at this state.
    pub fn equations(&self) -> Equations<S> {
        let (bits, n) = (self.bits, self.q.len());
        let small = [0, 1].map(|k| Jet::infinitesimal(bits + k));
        let mut mass = vec![vec![Jet::of(S::ZERO); n]; n];
        for i in 0..n {
            for j in 0..=i {
                let world = self.with(|world| {
                    world.bits += 2;
                    world.v[i] = world.v[i].add(&small[0]);
                    world.v[j] = world.v[j].add(&small[1]);
                });
                let entry = world.kinetic().part(bits + 1).part(bits);
                mass[i][j] = entry.clone();
                mass[j][i] = entry;
            }
        }
        let bias = (0..n).map(|i| {
            // d/dt ∂T/∂vᵢ along q' = v, v' = 0.
            let world = self.with(|world| {
                world.bits += 2;
                world.t = world.t.add(&small[1]);
                for (q, v) in world.q.iter_mut().zip(&self.v) {
                    *q = q.add(&small[1].mul(v));
                }
                world.v[i] = world.v[i].add(&small[0]);
            });
            let momentum = world.kinetic().part(bits + 1).part(bits);
            let slope = self.by_coordinate(i, |world| vec![world.kinetic()]);
            momentum.sub(&slope[0])
        });
        let bias = bias.collect();
        let applied = (0..n).map(|i| self.force_on(i)).collect();
        let rows_and_biases: Vec<(Vec<Jet<S>>, Jet<S>)> = self
            .constraints()
            .iter()
            .enumerate()
            .map(|(k, (_, holonomic))| {
                self.row(*holonomic, |world| world.constraints()[k].0.clone())
            })
            .collect();
        let (rows, constraint_bias) = rows_and_biases.into_iter().unzip();
        let slips = (0..self.machine.sliding.len())
            .map(|k| self.row(false, |world| world.slip(k)))
            .collect();
        Equations {
            mass,
            bias,
            applied,
            rows,
            constraint_bias,
            slips,
        }
    }

    fn slip(&self, guide: usize) -> Jet<S> {
        product(&self.directions(guide)[0], &self.relative(guide))
    }

    /// The row of a constraint and its γ: the derivatives of a position by coordinates, or of a rate by rates.
    fn row(&self, holonomic: bool, f: impl Fn(&Self) -> Jet<S>) -> (Vec<Jet<S>>, Jet<S>) {
        let n = self.q.len();
        let f = |world: &Self| vec![f(world)];
        let row = (0..n).map(|i| {
            if holonomic {
                self.by_coordinate(i, f).remove(0)
            } else {
                self.by_rate(i, f).remove(0)
            }
        });
        let row = row.collect();
        let constraint_bias = if holonomic {
            self.rates(|world| world.rates(f))
        } else {
            self.rates(f)
        };
        (row, constraint_bias[0].neg())
    }

    fn force_on(&self, i: usize) -> Jet<S> {
        let machine = self.machine;
        let slope = self.by_coordinate(i, |world| vec![world.potential()]);
        let drag = self.by_rate(i, |world| vec![world.dissipation()]);
        let mut sum = slope[0].add(&drag[0]).neg();
        for force in &machine.forces {
            match force {
                Force::At(point, force) => {
                    let lever = self.by_coordinate(i, |world| world.vector(point));
                    sum = sum.add(&product(&self.vector(force), &lever));
                }
                Force::Between(a, b, value) => {
                    let slope = self.by_coordinate(i, |world| vec![world.distance(a, b)]);
                    sum = sum.add(&self.expr(value).mul(&slope[0]));
                }
                Force::On(k, value) if *k == i => sum = sum.add(&self.expr(value)),
                Force::On(..) => {}
            }
        }
        for (body, torque) in &machine.torques {
            let torque = self.exprs(torque);
            if !machine.spatial {
                let lever = self.by_coordinate(i, |world| vec![world.turned(*body)]);
                sum = sum.add(&torque[0].mul(&lever[0]));
                continue;
            }
            let frame = machine.bodies[*body].frame.expect("it turns");
            let rates = self.by_coordinate(i, |world| world.flat_axes(frame));
            let axes = &self.poses[frame].axes;
            let omega = Self::spin(axes, &rates);
            let omega: Vec<Jet<S>> = axes.iter().map(|row| product(row, &omega)).collect();
            sum = sum.add(&product(&torque, &omega));
        }
        sum
    }

    /// The truth at this state, or `None` if the machine is singular, or if friction allows no motion or several.
    pub fn truth(&self) -> Option<Truth<S>> {
        let machine = self.machine;
        let n = machine.coordinates.len();
        let equations = self.equations();
        let values = |list: &[Jet<S>]| -> Vec<S> { list.iter().map(Jet::value).collect() };
        let m = equations.rows.len();
        let guides = machine.sliding.len();
        let slips: Vec<S> = (0..guides).map(|k| self.slip(k).value()).collect();
        // A slip within round-off counts as rest.
        let rests: Vec<bool> = slips.iter().map(|w| w.abs().to_f64() < 1e-12).collect();
        let sliding: Vec<usize> = (0..guides).filter(|k| !rests[*k]).collect();
        let mut found = Vec::new();
        for signs in 0..1usize << sliding.len() {
            // F = −s μ η N for sliding contacts; for sticking contacts F is the force that keeps them at rest.
            let side = |k: usize| {
                let place = sliding.iter().position(|other| *other == k);
                place.map(|place| if signs >> place & 1 == 0 { 1.0 } else { -1.0 })
            };
            let friction: Vec<Option<S>> = (0..guides)
                .map(|k| {
                    let mu = self.expr(&machine.sliding[k].friction).value();
                    side(k).map(|side| -(slips[k].sign() * S::from_f64(side) * mu))
                })
                .collect();
            let (matrix, right) = self.system(&equations, &friction);
            let size = matrix.iter().flatten().chain(&right);
            let size = size.map(|x| x.abs().to_f64()).fold(0.0, f64::max);
            let right = right.into_iter().map(|x| vec![x]).collect();
            let Some((solution, pivot)) = solve(matrix, right) else {
                continue;
            };
            let solution: Vec<S> = solution.into_iter().map(|row| row[0]).collect();
            let mut stuck = solution[n + m + guides..].iter();
            let forces: Vec<[S; 2]> = (0..guides)
                .map(|k| {
                    let normal = solution[n + m + k];
                    let of_slip = friction[k].map(|factor| factor * normal);
                    let held = || stuck.next().copied().unwrap_or(S::ZERO);
                    [normal, of_slip.unwrap_or_else(held)]
                })
                .collect();
            let fits = |k: usize| {
                let [normal, friction] = forces[k].map(|x| x.to_f64());
                let guide = &machine.sliding[k];
                let sticking = guide.sticking.as_ref().unwrap_or(&guide.friction);
                let most = self.expr(sticking).value().to_f64();
                match side(k) {
                    Some(side) => normal * side > 0.0,
                    // Close to the limit of sticking, round-off would decide.
                    None => friction.abs() < 0.9 * most * normal.abs(),
                }
            };
            if (0..guides).all(fits) {
                found.push((solution, pivot, size, forces));
            }
        }
        let [(solution, pivot, size, forces)] = &found[..] else {
            return None;
        };
        let size = solution
            .iter()
            .map(|x| x.abs().to_f64())
            .fold(*size, f64::max);
        let contacts = forces.iter().zip(&slips);
        let contacts = contacts
            .map(|([normal, friction], slip)| Contact {
                slip: *slip,
                normal: *normal,
                friction: *friction,
            })
            .collect();
        let moving = self.with(|world| {
            for (a, x) in world.a.iter_mut().zip(&solution[..n]) {
                *a = Jet::of(*x);
            }
        });
        Some(Truth {
            mass: equations.mass[..n]
                .iter()
                .map(|row| values(&row[..n]))
                .collect(),
            bias: values(&equations.bias[..n]),
            applied: values(&equations.applied[..n]),
            accelerations: solution[..n].to_vec(),
            multipliers: solution[n..][..m].to_vec(),
            contacts,
            kinetic: self.kinetic().value(),
            potential: self.potential().value(),
            dissipation: self.dissipation().value(),
            outputs: values(&moving.exprs(&machine.outputs)),
            pivot: *pivot,
            size,
        })
    }

    /// The linear equations for accelerations, multipliers, normal reactions, and the friction forces of sticking contacts. For
    /// a sliding contact `friction` holds the ratio of friction to normal reaction.
    fn system(&self, e: &Equations<S>, friction: &[Option<S>]) -> (Vec<Vec<S>>, Vec<S>) {
        let machine = self.machine;
        let (n, m, guides) = (
            machine.coordinates.len(),
            e.rows.len(),
            machine.sliding.len(),
        );
        let stuck: Vec<usize> = (0..guides).filter(|k| friction[*k].is_none()).collect();
        let length = n + m + guides + stuck.len();
        // M a − Gᵀ λ − Σ τᵀ F = f, in the row of a coordinate or of a displacement.
        let balance = |i: usize| -> (Vec<S>, S) {
            let mut row: Vec<S> = (0..n).map(|j| e.mass[i][j].value()).collect();
            row.extend(e.rows.iter().map(|g| -g[i].value()));
            row.extend((0..guides).map(|k| {
                let factor = friction[k].unwrap_or(S::ZERO);
                -(e.slips[k].0[i].value() * factor)
            }));
            row.extend(stuck.iter().map(|k| -e.slips[*k].0[i].value()));
            (row, e.applied[i].value() - e.bias[i].value())
        };
        let (mut matrix, mut right): (Vec<Vec<S>>, Vec<S>) = (0..n).map(balance).unzip();
        for (row, constraint_bias) in e.rows.iter().zip(&e.constraint_bias) {
            let mut line: Vec<S> = row[..n].iter().map(Jet::value).collect();
            line.resize(length, S::ZERO);
            matrix.push(line);
            right.push(constraint_bias.value());
        }
        for k in 0..guides {
            let normal = &self.directions(k)[1];
            let mut line = vec![S::ZERO; length];
            let mut known = S::ZERO;
            for (c, along) in normal.iter().enumerate() {
                let i = n + 2 * k + c;
                let (row, force) = balance(i);
                for (x, y) in line.iter_mut().zip(row) {
                    *x = *x + along.value() * y;
                }
                known = known + along.value() * force;
                // Every guide whose bodies this displacement separates contributes its normal reaction.
                for other in 0..guides {
                    let apart = self.by_rate(i, |world| world.relative(other));
                    let lever = product(&apart, &self.directions(other)[1]).value();
                    line[n + m + other] = line[n + m + other] - along.value() * lever;
                }
            }
            matrix.push(line);
            right.push(known);
        }
        for k in &stuck {
            let (row, slip_bias) = &e.slips[*k];
            let mut line: Vec<S> = row[..n].iter().map(Jet::value).collect();
            line.resize(length, S::ZERO);
            matrix.push(line);
            right.push(slip_bias.value());
        }
        (matrix, right)
    }

    /// The derivatives of the accelerations with respect to a variable, for a machine without guides.
    pub fn derivative(
        &self,
        variable: Variable,
        accelerations: &[S],
        multipliers: &[S],
    ) -> Option<Vec<S>> {
        let small = Jet::infinitesimal(self.bits);
        let bit = self.bits;
        let world = self.with(|world| {
            world.bits += 1;
            let place = match variable {
                Variable::Coordinate(i) => &mut world.q[i],
                Variable::Rate(i) => &mut world.v[i],
                Variable::Input(i) => &mut world.inputs[i],
                Variable::Parameter(i) => &mut world.parameters[i],
            };
            *place = place.add(&small);
        });
        let e = world.equations();
        let (n, m) = (accelerations.len(), multipliers.len());
        let (matrix, _) = self.system(&e, &[]);
        // K x = r, so K x' = r' − K' x.
        let right = (0..n + m).map(|i| {
            let mut sum = if i < n {
                e.applied[i].sub(&e.bias[i]).part(bit).value()
            } else {
                e.constraint_bias[i - n].part(bit).value()
            };
            for (j, a) in accelerations.iter().enumerate() {
                let entry = if i < n {
                    &e.mass[i][j]
                } else {
                    &e.rows[i - n][j]
                };
                sum = sum - entry.part(bit).value() * *a;
            }
            for (row, lambda) in e.rows.iter().zip(multipliers).filter(|_| i < n) {
                sum = sum + row[i].part(bit).value() * *lambda;
            }
            vec![sum]
        });
        let (solution, _) = solve(matrix, right.collect())?;
        Some(solution.into_iter().take(n).map(|row| row[0]).collect())
    }

    /// The values of expressions and their first and second derivatives along the motion with these accelerations.
    pub fn motion(&self, expressions: &[Expr], accelerations: &[S]) -> [Vec<S>; 3] {
        let world = self.with(|world| {
            for (a, x) in world.a.iter_mut().zip(accelerations) {
                *a = Jet::of(*x);
            }
        });
        let values = |list: Vec<Jet<S>>| -> Vec<S> { list.iter().map(Jet::value).collect() };
        [
            values(world.exprs(expressions)),
            values(world.rates(|world| world.exprs(expressions))),
            values(world.rates(|world| world.rates(|world| world.exprs(expressions)))),
        ]
    }
}

fn frozen(machine: &Machine) -> impl Iterator<Item = (usize, Approximation)> {
    of_kind(machine, Approximation::Frozen)
}

fn small(machine: &Machine) -> impl Iterator<Item = (usize, Approximation)> {
    of_kind(machine, Approximation::Small)
}

fn of_kind(machine: &Machine, kind: Approximation) -> impl Iterator<Item = (usize, Approximation)> {
    let all = machine.approximations.iter().copied();
    all.filter(move |(_, one)| *one == kind)
}

/// A state on the constraints near a given one, by Newton's method with minimum-norm steps; `None` if there is none nearby.
pub fn on_constraints<S: Scalar>(machine: &Machine, state: &State<S>) -> Option<State<S>> {
    let mut state = state.clone();
    let n = state.q.len();
    let count = machine.constraints.len() + 2 * machine.rolling.len();
    if count == 0 {
        return Some(state);
    }
    // The minimum-norm x with A x = b.
    let shortest = |rows: &[Vec<S>], right: &[S]| -> Option<Vec<S>> {
        let inner = |a: &[S], b: &[S]| {
            let parts = a.iter().zip(b);
            parts.fold(S::ZERO, |sum, (a, b)| sum + *a * *b)
        };
        let gram = rows
            .iter()
            .map(|a| rows.iter().map(|b| inner(a, b)).collect());
        let right = right.iter().map(|x| vec![*x]).collect();
        let (factors, pivot) = solve(gram.collect(), right)?;
        if pivot < 1e-6 {
            return None;
        }
        Some(
            (0..n)
                .map(|i| {
                    let parts = rows.iter().zip(&factors);
                    parts.fold(S::ZERO, |sum, (row, x)| sum + row[i] * x[0])
                })
                .collect(),
        )
    };
    let mut size = f64::INFINITY;
    for _ in 0..12 {
        let world = World::new(machine, &state);
        let all = world.constraints();
        let holonomic: Vec<usize> = (0..count).filter(|k| all[*k].1).collect();
        if holonomic.is_empty() {
            size = 0.0;
            break;
        }
        let right: Vec<S> = holonomic.iter().map(|k| -all[*k].0.value()).collect();
        size = right.iter().map(|x| x.abs().to_f64()).fold(0.0, f64::max);
        if size < 1e-28 {
            break;
        }
        let rows: Vec<Vec<S>> = holonomic
            .iter()
            .map(|k| {
                let (row, _) = world.row(true, |world| world.constraints()[*k].0.clone());
                row[..n].iter().map(Jet::value).collect()
            })
            .collect();
        let step = shortest(&rows, &right)?;
        for (q, x) in state.q.iter_mut().zip(&step) {
            *q = *q + *x;
        }
    }
    if size > 1e-28 || state.q.iter().any(|q| q.abs().to_f64() > 8.0) {
        return None;
    }
    let world = World::new(machine, &state);
    let rate = |world: &World<'_, S>, k: usize| -> Jet<S> {
        let all = world.constraints();
        if all[k].1 {
            world.rate(|world| world.constraints()[k].0.clone())
        } else {
            all[k].0.clone()
        }
    };
    let rows: Vec<Vec<S>> = (0..count)
        .map(|k| {
            let (row, _) = world.row(false, |world| rate(world, k));
            row[..n].iter().map(Jet::value).collect()
        })
        .collect();
    let right: Vec<S> = (0..count).map(|k| -rate(&world, k).value()).collect();
    let step = shortest(&rows, &right)?;
    for (v, x) in state.v.iter_mut().zip(&step) {
        *v = *v + *x;
    }
    Some(state)
}
