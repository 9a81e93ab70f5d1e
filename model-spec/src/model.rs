//! What a machine is: names found, units agreed, families unrolled, variants merged.
//!
//! A [`Model`] says nothing about how it was written (no tokens, only spans for messages) and
//! nothing about equations. Its expressions live in one [`Dag`]. What holds here:
//!
//! * every expression is defined over symbols of this model, and its unit is the one its place
//!   demands;
//! * stages are what [`stage`] says: a mass is no later than [`stage::PARAMETER`], a position no
//!   later than [`stage::POSITION`], and so on for every field, as its docs say;
//! * a pose comes after its parent in [`Model::poses`]; pose 0 is the ground;
//! * vectors and points have two components in the plane and three in space, along the ground's
//!   axes.

use lagrangian_symbolic::{Dag, Expr};

use crate::source::Span;
use crate::syntax::SectionKind;
use crate::unit::Unit;
pub use crate::unit::{Compliance, ImpactLaw, ImpactOrder, Name, Painleve, Stages, Variable};

pub mod bounds;
pub mod circles;
pub mod element;
pub mod polygons;
mod published;
pub mod quaternion;
pub mod spheres;

pub use published::*;

use bounds::Bound;
use element::Element;
use polygons::Corner;
use quaternion::Quaternion;

/// When a value becomes known: the order in which work can be done once and kept.
pub mod stage {
    use lagrangian_symbolic::Stage;

    /// Known when the machine is derived.
    pub const CONSTANT: Stage = Stage(0);
    /// Known when a run starts.
    pub const PARAMETER: Stage = Stage(1);
    /// Depends on time.
    pub const TIME: Stage = Stage(2);
    /// Depends on coordinates.
    pub const POSITION: Stage = Stage(3);
    /// Depends on velocities.
    pub const VELOCITY: Stage = Stage(4);
    /// Depends on inputs, which may change at will while the machine runs.
    pub const INPUT: Stage = Stage(5);
    /// Depends on accelerations.
    pub const ACCELERATION: Stage = Stage(6);
}

/// A machine: what it is, not what its equations are.
#[derive(Clone)]
pub struct Model<'d> {
    /// Where its expressions live.
    pub dag: &'d Dag,
    /// The machine's name, a Rust type name.
    pub name: String,
    /// What the spec says about it.
    pub docs: String,
    /// Plane or space.
    pub space: Space,
    /// The machine's name in the spec.
    pub span: Span,
    /// The symbol `t`.
    pub time: Expr<'d>,
    /// Run-time parameters, in the order of their declaration.
    pub parameters: Vec<Parameter<'d>>,
    /// Parameters that follow from others, in the order of their declaration; expressions hold their formulas already.
    pub derived_parameters: Vec<DerivedParameter<'d>>,
    /// Compile-time constants; expressions hold their values already.
    pub constants: Vec<Constant<'d>>,
    /// Generalized coordinates, in the order of `q`: those of the spec, then the integrals of its states of
    /// first order.
    pub coordinates: Vec<Coordinate<'d>>,
    /// Values that the user sets while the machine runs.
    pub inputs: Vec<Input<'d>>,
    /// Facts that the simplifier may use and a run checks.
    pub assumptions: Vec<Assumption<'d>>,
    /// Every pose that a frame or body is built from, parents first.
    pub poses: Vec<Pose<'d>>,
    /// The fours of coordinates by which frames are turned, each once; no coordinate is in two of them.
    pub quaternions: Vec<Quaternion<'d>>,
    /// Named frames of reference.
    pub frames: Vec<Frame>,
    /// Rigid bodies and particles, and behind them what `rotors` says: bodies without mass that turn by an angle.
    pub bodies: Vec<Body<'d>>,
    /// Whatever contributes to the equations beside the inertia of the bodies: springs, gravity, forces,
    /// constraints, section by section.
    pub elements: Vec<Element<'d>>,
    /// This machine with every guide of `sliding` relaxed: what the guided body is built on can
    /// move off, by two coordinates for each guide behind all others. It tells what holds the guides
    /// shut. None where nothing slides.
    pub relaxed: Option<Box<Model<'d>>>,
    /// Circles that can touch, or in space spheres.
    pub circles: Vec<Circle<'d>>,
    /// Unilateral contacts.
    pub contacts: Vec<Contact<'d>>,
    /// Coordinates that are not treated exactly.
    pub approximations: Vec<Approximation>,
    /// Quantities to observe.
    pub outputs: Vec<Output<'d>>,
    /// What the accelerations are to be differentiated by, each once, in the order of
    /// [`Variable`].
    pub derivatives: Vec<Variable>,
    /// Which stages of the accelerations are to be computed by themselves.
    pub stages: Stages,
    /// Where emitted code is asked to have the Taylor series of the motion, if it is.
    pub taylor: Option<Span>,
    /// Which start values stay as they are where the start does not obey the constraints:
    /// coordinates and rates, each once.
    pub kept: Vec<Variable>,
    /// Where the fastest motion ends, by coordinates; may depend on parameters. Empty where nobody
    /// says it.
    pub destination: Vec<Expr<'d>>,
    /// Equations that somebody printed.
    pub published: Vec<Published<'d>>,
    /// What masses, coefficients and the like must obey.
    pub bounds: Vec<Bound<'d>>,
    /// The headings of the sections that the machine and its bases have, where each is said first.
    pub sections: Vec<(SectionKind, Span)>,
}

impl<'d> Model<'d> {
    /// How a frame or a body is turned.
    pub fn rotation(&self, place: Place) -> Rotation<'d> {
        match place {
            Place::Frame(pose) => Rotation::Frame(pose),
            Place::Body(body) => self.bodies[body].rotation,
        }
    }
}

impl Model<'_> {
    /// Where a section begins, for what is to be said about all of it.
    pub fn section(&self, kind: SectionKind) -> Option<Span> {
        let found = self.sections.iter().find(|(section, _)| *section == kind);
        found.map(|(_, span)| *span)
    }
}

/// Where the machine lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Two dimensions; rotations are angles.
    Plane,
    /// Three dimensions.
    Space,
}

impl Space {
    /// The number of components of a vector.
    pub fn dimension(self) -> usize {
        match self {
            Space::Plane => 2,
            Space::Space => 3,
        }
    }

    /// How many components the normal reaction of a guide has. In the plane it has one, along the normal; in space a guide
    /// presses in any direction across, and its reaction is a vector in ground axes.
    pub fn reaction_axes(self) -> usize {
        match self {
            Space::Plane => 1,
            Space::Space => 3,
        }
    }
}

/// A run-time parameter.
#[derive(Clone)]
pub struct Parameter<'d> {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Its unit.
    pub unit: Unit,
    /// Its unit as the spec writes it: `N/m` and `rad`, which are `kg/s^2` and `1` to [`Unit`].
    pub unit_text: String,
    /// Its default, a constant.
    pub default: Option<Expr<'d>>,
    /// Its symbol.
    pub symbol: Expr<'d>,
    /// Its name in the spec.
    pub span: Span,
}

/// A parameter that follows from others: `J: kg*m^2 = m*r^2/2`.
#[derive(Clone)]
pub struct DerivedParameter<'d> {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Its unit.
    pub unit: Unit,
    /// Its unit as the spec writes it: `N/m` and `rad`, which are `kg/s^2` and `1` to [`Unit`].
    pub unit_text: String,
    /// Its value in that unit, of parameters.
    pub value: Expr<'d>,
    /// Its name in the spec.
    pub span: Span,
}

/// A value folded in when the machine is derived.
#[derive(Clone)]
pub struct Constant<'d> {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Its unit.
    pub unit: Unit,
    /// Its unit as the spec writes it: `N/m` and `rad`, which are `kg/s^2` and `1` to [`Unit`].
    pub unit_text: String,
    /// Its value.
    pub value: Expr<'d>,
    /// Its name in the spec.
    pub span: Span,
}

/// A generalized coordinate.
#[derive(Clone)]
pub struct Coordinate<'d> {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Its unit.
    pub unit: Unit,
    /// Its unit as the spec writes it: `N/m` and `rad`, which are `kg/s^2` and `1` to [`Unit`].
    pub unit_text: String,
    /// Where it starts; may depend on parameters.
    pub start: Expr<'d>,
    /// Its rate there, 0 where the spec gives none; may depend on parameters.
    pub start_rate: Expr<'d>,
    /// None of a coordinate. A state of first order `s` is the rate of a coordinate that nothing depends
    /// on, its integral over time; then this is `ds/dt`, of states, coordinates, rates, inputs and time.
    pub rate: Option<Expr<'d>>,
    /// Its symbol, that of its velocity, and that of its acceleration.
    pub q: Expr<'d>,
    /// The symbol of its velocity.
    pub v: Expr<'d>,
    /// The symbol of its acceleration.
    pub a: Expr<'d>,
    /// Its name in the spec.
    pub span: Span,
}

/// A value that the user sets while the machine runs.
#[derive(Clone)]
pub struct Input<'d> {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Its unit.
    pub unit: Unit,
    /// Its unit as the spec writes it: `N/m` and `rad`, which are `kg/s^2` and `1` to [`Unit`].
    pub unit_text: String,
    /// Its value where nobody sets it, a constant; 0 where the spec gives none.
    pub default: Expr<'d>,
    /// Its symbol.
    pub symbol: Expr<'d>,
    /// Its name in the spec.
    pub span: Span,
}

/// A fact: `excess > 0`, or `excess ≥ 0`.
#[derive(Clone)]
pub struct Assumption<'d> {
    /// As the spec writes it.
    pub text: String,
    /// The greater side less the smaller.
    pub excess: Expr<'d>,
    /// Whether 0 is excluded.
    pub strict: bool,
    /// Where the spec says it.
    pub span: Span,
}

/// The index of a pose in [`Model::poses`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PoseId(pub u32);

impl PoseId {
    /// The ground: origin 0, the ground's axes.
    pub const GROUND: PoseId = PoseId(0);

    /// Its place in [`Model::poses`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Where a frame is and how it is turned, and how it got there from its parent.
#[derive(Clone)]
pub struct Pose<'d> {
    /// What it was made from; the ground is its own parent.
    pub parent: PoseId,
    /// What was done to the parent.
    pub step: Step<'d>,
    /// Its origin, in ground axes.
    pub origin: Vec<Expr<'d>>,
    /// Its axes: `axes[k]` is the k-th axis as a vector in ground axes.
    pub axes: Vec<Vec<Expr<'d>>>,
    /// The angle by which it is turned, in the plane: the sum of its turns. Zero in space.
    pub angle: Expr<'d>,
}

/// How a pose differs from its parent.
#[derive(Clone)]
pub enum Step<'d> {
    /// Not at all: the ground.
    Ground,
    /// The origin moves along the parent's axes.
    Shift(Vec<Expr<'d>>),
    /// A turn about an axis (0, 1, 2 for x, y, z) of the frame itself; in the plane always 2.
    Turn {
        /// The axis.
        axis: usize,
        /// The angle.
        angle: Expr<'d>,
    },
    /// A turn by four coordinates, in space: see [`quaternion`].
    Quaternion([Expr<'d>; 4]),
}

/// A named frame of reference.
#[derive(Clone)]
pub struct Frame {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Where it is.
    pub pose: PoseId,
    /// Its name in the spec.
    pub span: Span,
}

/// A rigid body, or a particle.
#[derive(Clone)]
pub struct Body<'d> {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Its mass; constant along the motion.
    pub mass: Expr<'d>,
    /// Its inertia about its mass centre; constant along the motion.
    pub inertia: Inertia<'d>,
    /// Its mass centre.
    pub at: Vec<Expr<'d>>,
    /// The mass centre along the axes of a frame, where the spec gives it so: `arm.point(0, 0,
    /// l/2)`, or the frame's origin. In space the motion is shorter that way.
    pub local: Option<Local<'d>>,
    /// How it is turned.
    pub rotation: Rotation<'d>,
    /// The corners of a polygon that is drawn for it, in their order, along the axes of its frame, or from its mass centre
    /// along its own axes; none where nothing is said of its shape.
    pub outline: Vec<Vec<Expr<'d>>>,
    /// Its name in the spec.
    pub span: Span,
    /// What the spec says of where it is: `at`, or `frame` where that is all.
    pub place: Span,
}

/// A point along the axes of a frame.
#[derive(Clone, Debug)]
pub struct Local<'d> {
    /// The frame.
    pub pose: PoseId,
    /// The point, from the frame's origin.
    pub point: Vec<Expr<'d>>,
}

/// Inertia about the mass centre.
#[derive(Clone)]
pub enum Inertia<'d> {
    /// None: rotation carries no energy.
    Particle,
    /// In the plane.
    Planar(Expr<'d>),
    /// In space, about the body's own axes: the symmetric tensor's `xx, yy, zz, xy, xz, yz`, signs
    /// included; a body given by three moments has zeros for the rest.
    Tensor([Expr<'d>; 6]),
}

/// How a body is turned.
#[derive(Clone, Copy)]
pub enum Rotation<'d> {
    /// The spec does not say; fine for a particle.
    Unspecified,
    /// By an angle from the ground, in the plane.
    Angle(Expr<'d>),
    /// As a frame is.
    Frame(PoseId),
}

/// What a body slides on, a circle sits on, or a force acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A frame of reference.
    Frame(PoseId),
    /// A body, by its index.
    Body(usize),
}

/// A circle, or a sphere in space, fixed to a frame or body.
#[derive(Clone)]
pub struct Circle<'d> {
    /// Its name.
    pub name: Name,
    /// What it is fixed to.
    pub on: Place,
    /// Its centre, in the axes of what it is fixed to.
    pub center: Vec<Expr<'d>>,
    /// Its radius.
    pub radius: Expr<'d>,
    /// Its name in the spec.
    pub span: Span,
}

/// A circle and what it touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Touching {
    /// The index of the circle.
    pub circle: usize,
    /// What it touches.
    pub surface: Surface,
}

/// What a circle touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// Another circle, by its index, in which it is.
    Inside(usize),
    /// Another circle, by its index, out of which it is.
    Outside(usize),
    /// The first axis of a frame, on the side of the second; in space the plane of its first two axes, on the side of the third.
    Along(PoseId),
}

/// The most unilateral contacts of a machine.
pub const MOST_UNILATERAL: usize = 250;

/// A unilateral contact: gap ≥ 0.
#[derive(Clone)]
pub struct Contact<'d> {
    /// Its name.
    pub name: Name,
    /// Which circles, or the gap and the slip velocity in terms of coordinates.
    pub geometry: ContactGeometry<'d>,
    /// What it does where its gap closes.
    pub response: Response<'d>,
    /// Coefficient of friction; none where there is no friction at all.
    pub friction: Option<Expr<'d>>,
    /// Coefficient of friction of what sticks, where it is another.
    pub static_friction: Option<Expr<'d>>,
    /// Coefficient of rolling resistance, a length in m; none where nothing resists rolling.
    pub rolling_resistance: Option<Expr<'d>>,
    /// Its name in the spec.
    pub span: Span,
}

impl Contact<'_> {
    /// Whether friction acts along two tangents, in space.
    pub fn slips_across(&self, space: Space) -> bool {
        let has_two = match &self.geometry {
            ContactGeometry::Circles(_) | ContactGeometry::Point { .. } => space == Space::Space,
            ContactGeometry::Corner(_) => false,
            ContactGeometry::Expressions { across, .. } => across.is_some(),
        };
        has_two && self.friction.is_some()
    }
}

/// What a contact does where its gap closes.
#[derive(Clone, Copy)]
pub enum Response<'d> {
    /// The gap stays ≥ 0: there is an impact.
    Rigid {
        /// How it bounces.
        law: ImpactLaw,
        /// Whether with the others or one after the other.
        order: ImpactOrder,
        /// What becomes of it where its friction leaves no motion.
        painleve: Painleve,
        /// Coefficients of restitution along the normal and along the tangent, 0 there where nothing is said.
        restitution: [Expr<'d>; 2],
    },
    /// It yields, and presses by a law of force.
    Compliant {
        /// The law.
        law: Compliance,
        /// Its parameters, in SI units; 0 where it has but one.
        parameters: [Expr<'d>; 2],
    },
}

impl<'d> Response<'d> {
    /// Its two numbers: coefficients of restitution, or parameters of a law of force.
    pub fn coefficients(self) -> [Expr<'d>; 2] {
        match self {
            Response::Rigid { restitution, .. } => restitution,
            Response::Compliant { parameters, .. } => parameters,
        }
    }

    /// How it bounces, if it does.
    pub fn impact_law(self) -> Option<ImpactLaw> {
        match self {
            Response::Rigid { law, .. } => Some(law),
            Response::Compliant { .. } => None,
        }
    }

    /// In which order it bounces with others, if it does.
    pub fn order(self) -> Option<ImpactOrder> {
        match self {
            Response::Rigid { order, .. } => Some(order),
            Response::Compliant { .. } => None,
        }
    }

    /// What becomes of it where its friction leaves no motion.
    pub fn painleve(self) -> Painleve {
        match self {
            Response::Rigid { painleve, .. } => painleve,
            Response::Compliant { .. } => Painleve::Error,
        }
    }

    /// By which law it presses, if it yields.
    pub fn compliance(self) -> Option<Compliance> {
        match self {
            Response::Rigid { .. } => None,
            Response::Compliant { law, .. } => Some(law),
        }
    }
}

/// How a contact is given.
#[derive(Clone)]
pub enum ContactGeometry<'d> {
    /// By two circles.
    Circles(Touching),
    /// By a point, which is a circle of no radius, and what it touches.
    Point {
        /// The point.
        point: Circle<'d>,
        /// What it touches.
        surface: Surface,
    },
    /// By a corner of a convex polygon and another such polygon, in the plane.
    Corner(Corner<'d>),
    /// By expressions.
    Expressions {
        /// The gap, which stays ≥ 0.
        gap: Expr<'d>,
        /// The slip velocity.
        slip: Expr<'d>,
        /// In space, the slip velocity in a second direction, if friction acts in two.
        across: Option<Expr<'d>>,
    },
}

/// A coordinate that is not treated exactly.
#[derive(Clone, Copy, Debug)]
pub struct Approximation {
    /// Its index.
    pub coordinate: usize,
    /// How it is treated.
    pub kind: ApproximationKind,
    /// Where the spec says it.
    pub span: Span,
}

/// What an approximation neglects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ApproximationKind {
    /// sin θ → 0 and cos θ → 1 in the velocities of the bodies, after differentiating.
    Frozen,
    /// Energies and dissipation to second order in the coordinate and its rate together.
    Small,
}

/// A quantity to observe.
#[derive(Clone)]
pub struct Output<'d> {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Its unit.
    pub unit: Unit,
    /// Its unit as the spec writes it: `N/m` and `rad`, which are `kg/s^2` and `1` to [`Unit`].
    pub unit_text: String,
    /// Its value; accelerations may occur.
    pub value: Expr<'d>,
    /// Its name in the spec.
    pub span: Span,
}
