//! A machine as a value, from which its spec is printed and the truth is computed.

/// A dimensionless scalar expression in the quantities of a machine.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A multiple of 1/64, which text, binary64 and double-double represent exactly.
    Number(f64),
    Parameter(usize),
    Constant(usize),
    Define(usize),
    Coordinate(usize),
    Input(usize),
    Time,
    Sum(Vec<Expr>),
    Product(Vec<Expr>),
    Quotient(Box<Expr>, Box<Expr>),
    /// The exponent is in units of one half.
    Power(Box<Expr>, i64),
    Sin(Box<Expr>),
    Cos(Box<Expr>),
    Exp(Box<Expr>),
    /// The angle of the vector (second, first), `atan2(first, second)`.
    Angle(Box<Expr>, Box<Expr>),
    /// The total time derivative.
    Der(Box<Expr>),
    Dot(Box<Vector>, Box<Vector>),
    Norm(Box<Vector>),
}

/// A vector or a point; its unit is `Vector::unit`.
#[derive(Clone, Debug, PartialEq)]
pub enum Vector {
    /// Components along the ground's axes.
    Free(Vec<Expr>, Unit),
    Origin(usize),
    /// A point of a frame.
    Point(usize, Vec<Expr>),
    /// Dimensionless components along a frame's axes.
    Along(usize, Vec<Expr>),
    Centre(usize),
    Define(usize),
    Less(Box<Vector>, Box<Vector>),
    Scaled(Expr, Box<Vector>),
    Der(Box<Vector>),
}

/// Exponents of m, s and N.
pub type Unit = [i32; 3];
pub const PURE: Unit = [0, 0, 0];
pub const METRE: Unit = [1, 0, 0];
pub const NEWTON: Unit = [0, 0, 1];

#[derive(Clone, Debug)]
pub struct Value {
    pub name: String,
    pub value: f64,
}

#[derive(Clone, Debug)]
pub struct Coordinate {
    pub name: String,
    pub start: f64,
    pub rate: f64,
    /// Whether start and rate are kept fixed if the start violates the constraints; here
    /// it satisfies them.
    pub kept: [bool; 2],
}

#[derive(Clone, Debug)]
pub enum Meaning {
    Number(Expr),
    Vector(Vector),
}

#[derive(Clone, Debug)]
pub struct Frame {
    /// 0 is the ground; otherwise an earlier frame, on which this one is built.
    pub parent: usize,
    pub step: Step,
}

#[derive(Clone, Debug)]
pub enum Step {
    Shift(Vec<Expr>),
    /// About axis 0, 1 or 2; in the plane always 2.
    Turn(usize, Expr),
}

#[derive(Clone, Debug)]
pub struct Body {
    pub name: String,
    pub mass: Expr,
    /// One moment of inertia in the plane; three or six entries in space.
    pub inertia: Vec<Expr>,
    pub frame: Option<usize>,
    pub at: Option<Vector>,
    pub angle: Option<Expr>,
}

#[derive(Clone, Debug)]
pub struct Elastic {
    pub name: String,
    /// Stiffness or damping coefficient.
    pub factor: Expr,
    pub stretch: Stretch,
}

#[derive(Clone, Debug)]
pub enum Stretch {
    Number(Expr),
    Points(Vector, Vector, Option<Expr>),
}

/// An elastic joint of two frames in the plane; 0 is the ground.
#[derive(Clone, Debug)]
pub struct Bushing {
    pub from: usize,
    pub to: usize,
    pub stiffness: [Expr; 3],
    pub damping: Option<[Expr; 3]>,
    pub preload: Option<[Expr; 3]>,
}

#[derive(Clone, Debug)]
pub enum Force {
    At(Vector, Vector),
    /// An actuator that pushes two points apart.
    Between(Vector, Vector, Expr),
    On(usize, Expr),
}

#[derive(Clone, Debug)]
pub struct Constraint {
    pub name: String,
    pub left: Expr,
    pub right: Expr,
    pub holonomic: bool,
}

#[derive(Clone, Debug)]
pub struct Circle {
    /// A frame or a body.
    pub on: Result<usize, usize>,
    pub centre: [Expr; 2],
    pub radius: Expr,
}

#[derive(Clone, Debug)]
pub enum Surface {
    Inside(usize),
    Outside(usize),
    Along(usize),
}

#[derive(Clone, Debug)]
pub struct Rolling {
    pub name: String,
    pub circle: usize,
    pub surface: Surface,
}

#[derive(Clone, Debug)]
pub struct Guide {
    pub name: String,
    pub body: usize,
    /// A frame; 0 is the ground.
    pub on: usize,
    pub direction: Vector,
    pub normal: Option<Vector>,
    pub friction: Expr,
    pub sticking: Option<Expr>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Approximation {
    Frozen,
    Small,
}

/// A closed polygon of links, cut after one of its links; both chains are built from the ground.
#[derive(Clone, Debug)]
pub struct Loop {
    pub lengths: Vec<Expr>,
    pub anchor: [Expr; 2],
    pub cut: usize,
}

#[derive(Clone, Debug, Default)]
pub struct Machine {
    pub spatial: bool,
    pub parameters: Vec<Value>,
    pub constants: Vec<Value>,
    pub inputs: Vec<Value>,
    pub coordinates: Vec<Coordinate>,
    pub defines: Vec<Meaning>,
    /// Expressions that are assumed positive.
    pub assumptions: Vec<Expr>,
    pub frames: Vec<Frame>,
    pub bodies: Vec<Body>,
    pub gravity: Option<Vec<Expr>>,
    pub springs: Vec<Elastic>,
    pub torsions: Vec<(Expr, Expr)>,
    pub dampers: Vec<Elastic>,
    pub bushings: Vec<Bushing>,
    pub potentials: Vec<Expr>,
    pub dissipations: Vec<Expr>,
    pub forces: Vec<Force>,
    pub torques: Vec<(usize, Vec<Expr>)>,
    pub constraints: Vec<Constraint>,
    pub circles: Vec<Circle>,
    pub rolling: Vec<Rolling>,
    pub sliding: Vec<Guide>,
    pub approximations: Vec<(usize, Approximation)>,
    pub outputs: Vec<Expr>,
    /// Whether the accelerations are differentiated with respect to coordinates, rates,
    /// inputs and parameters.
    pub derivatives: [bool; 4],
    /// Whether time and coordinates are stages.
    pub stages: [bool; 2],
    pub closed: Option<Loop>,
}

impl Machine {
    pub fn dimension(&self) -> usize {
        if self.spatial { 3 } else { 2 }
    }

    /// Calls a function on every expression of the machine, but not on its subexpressions.
    pub fn expressions(&mut self, f: &mut dyn FnMut(&mut Expr)) {
        for define in &mut self.defines {
            match define {
                Meaning::Number(e) => f(e),
                Meaning::Vector(v) => v.expressions(f),
            }
        }
        self.assumptions.iter_mut().for_each(&mut *f);
        for frame in &mut self.frames {
            match &mut frame.step {
                Step::Shift(shift) => shift.iter_mut().for_each(&mut *f),
                Step::Turn(_, angle) => f(angle),
            }
        }
        for body in &mut self.bodies {
            f(&mut body.mass);
            body.inertia.iter_mut().for_each(&mut *f);
            body.angle.iter_mut().for_each(&mut *f);
        }
        self.gravity.iter_mut().flatten().for_each(&mut *f);
        for one in self.springs.iter_mut().chain(&mut self.dampers) {
            f(&mut one.factor);
            match &mut one.stretch {
                Stretch::Number(e) => f(e),
                Stretch::Points(_, _, length) => length.iter_mut().for_each(&mut *f),
            }
        }
        for (stiffness, twist) in &mut self.torsions {
            f(stiffness);
            f(twist);
        }
        for one in &mut self.bushings {
            let given = [&mut one.damping, &mut one.preload];
            let given = given.into_iter().flatten().flatten();
            one.stiffness.iter_mut().chain(given).for_each(&mut *f);
        }
        self.potentials.iter_mut().for_each(&mut *f);
        self.dissipations.iter_mut().for_each(&mut *f);
        for force in &mut self.forces {
            if let Force::On(_, value) | Force::Between(_, _, value) = force {
                f(value);
            }
        }
        for (_, torque) in &mut self.torques {
            torque.iter_mut().for_each(&mut *f);
        }
        for constraint in &mut self.constraints {
            f(&mut constraint.left);
            f(&mut constraint.right);
        }
        for circle in &mut self.circles {
            circle.centre.iter_mut().for_each(&mut *f);
            f(&mut circle.radius);
        }
        for guide in &mut self.sliding {
            f(&mut guide.friction);
            guide.sticking.iter_mut().for_each(&mut *f);
        }
        self.outputs.iter_mut().for_each(&mut *f);
        if let Some(closed) = &mut self.closed {
            closed.lengths.iter_mut().for_each(&mut *f);
            closed.anchor.iter_mut().for_each(&mut *f);
        }
        self.vectors(&mut |v| v.expressions(f));
    }

    /// Calls a function on every vector that is not within a scalar expression, but not
    /// on its parts.
    pub fn vectors(&mut self, f: &mut dyn FnMut(&mut Vector)) {
        for body in &mut self.bodies {
            body.at.iter_mut().for_each(&mut *f);
        }
        for one in self.springs.iter_mut().chain(&mut self.dampers) {
            if let Stretch::Points(a, b, _) = &mut one.stretch {
                f(a);
                f(b);
            }
        }
        for force in &mut self.forces {
            if let Force::At(first, second) | Force::Between(first, second, _) = force {
                f(first);
                f(second);
            }
        }
        for guide in &mut self.sliding {
            f(&mut guide.direction);
            guide.normal.iter_mut().for_each(&mut *f);
        }
    }

    /// Calls a function on every vector, including those within expressions and definitions.
    pub fn all_vectors(&mut self, f: &mut dyn FnMut(&mut Vector)) {
        self.vectors(&mut |v| v.each(f));
        for define in &mut self.defines {
            if let Meaning::Vector(v) = define {
                v.each(f);
            }
        }
        self.expressions(&mut |e| e.vectors(f));
    }

    /// Replaces all expressions from the inside outward.
    pub fn replace(&mut self, f: &mut dyn FnMut(&mut Expr)) {
        self.expressions(&mut |e| e.each(f));
    }
}

impl Expr {
    /// Calls a function on all subexpressions from the inside outward, and on the expression itself.
    pub fn each(&mut self, f: &mut dyn FnMut(&mut Expr)) {
        match self {
            Expr::Sum(parts) | Expr::Product(parts) => {
                parts.iter_mut().for_each(|part| part.each(f));
            }
            Expr::Quotient(a, b) | Expr::Angle(a, b) => {
                a.each(f);
                b.each(f);
            }
            Expr::Power(a, _) | Expr::Sin(a) | Expr::Cos(a) | Expr::Exp(a) | Expr::Der(a) => {
                a.each(f);
            }
            Expr::Dot(u, v) => {
                u.expressions(&mut |e| e.each(f));
                v.expressions(&mut |e| e.each(f));
            }
            Expr::Norm(u) => u.expressions(&mut |e| e.each(f)),
            _ => {}
        }
        f(self);
    }

    /// Calls a function on every vector within the expression.
    pub fn vectors(&mut self, f: &mut dyn FnMut(&mut Vector)) {
        self.each(&mut |e| match e {
            Expr::Dot(u, v) => {
                u.each(f);
                v.each(f);
            }
            Expr::Norm(u) => u.each(f),
            _ => {}
        });
    }

    /// Whether the expression or a subexpression has a property.
    pub fn any(&self, property: impl Fn(&Expr) -> bool) -> bool {
        let mut found = false;
        self.clone().each(&mut |e| found |= property(e));
        found
    }
}

impl Vector {
    /// Calls a function on the scalar expressions within the vector, but not
    /// on their subexpressions.
    pub fn expressions(&mut self, f: &mut dyn FnMut(&mut Expr)) {
        match self {
            Vector::Free(parts, _) | Vector::Point(_, parts) | Vector::Along(_, parts) => {
                parts.iter_mut().for_each(f);
            }
            Vector::Origin(_) | Vector::Centre(_) | Vector::Define(_) => {}
            Vector::Less(a, b) => {
                a.expressions(f);
                b.expressions(f);
            }
            Vector::Scaled(e, a) => {
                f(e);
                a.expressions(f);
            }
            Vector::Der(a) => a.expressions(f),
        }
    }

    /// Calls a function on all parts that are vectors, from the inside outward, and on
    /// the vector itself.
    pub fn each(&mut self, f: &mut dyn FnMut(&mut Vector)) {
        match self {
            Vector::Less(a, b) => {
                a.each(f);
                b.each(f);
            }
            Vector::Scaled(_, a) | Vector::Der(a) => a.each(f),
            _ => {}
        }
        f(self);
    }

    pub fn unit(&self, machine: &Machine) -> Unit {
        match self {
            Vector::Free(_, unit) => *unit,
            Vector::Origin(_) | Vector::Point(..) | Vector::Centre(_) => METRE,
            Vector::Along(..) => PURE,
            Vector::Define(k) => match &machine.defines[*k] {
                Meaning::Vector(v) => v.unit(machine),
                Meaning::Number(_) => unreachable!("a definition of a vector"),
            },
            Vector::Less(a, _) | Vector::Scaled(_, a) => a.unit(machine),
            Vector::Der(a) => {
                let [m, s, n] = a.unit(machine);
                [m, s - 1, n]
            }
        }
    }

    pub fn less(self, other: Vector) -> Vector {
        Vector::Less(Box::new(self), Box::new(other))
    }
}

pub fn num(x: f64) -> Expr {
    Expr::Number(x)
}

pub fn sum(parts: Vec<Expr>) -> Expr {
    Expr::Sum(parts)
}

pub fn mul(a: Expr, b: Expr) -> Expr {
    Expr::Product(vec![a, b])
}

pub fn neg(a: Expr) -> Expr {
    mul(num(-1.0), a)
}

pub fn sin(a: Expr) -> Expr {
    Expr::Sin(Box::new(a))
}

pub fn cos(a: Expr) -> Expr {
    Expr::Cos(Box::new(a))
}

pub fn der(a: Expr) -> Expr {
    Expr::Der(Box::new(a))
}

pub fn power(a: Expr, halves: i64) -> Expr {
    Expr::Power(Box::new(a), halves)
}

pub fn quotient(a: Expr, b: Expr) -> Expr {
    Expr::Quotient(Box::new(a), Box::new(b))
}

pub fn dot(a: Vector, b: Vector) -> Expr {
    Expr::Dot(Box::new(a), Box::new(b))
}

pub fn norm(a: Vector) -> Expr {
    Expr::Norm(Box::new(a))
}

pub fn q(i: usize) -> Expr {
    Expr::Coordinate(i)
}
