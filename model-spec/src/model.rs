//! The meaning of a spec: names resolved, units checked, families unrolled, variants merged.
//!
//! A [`Model`] keeps no syntax (no tokens, and spans only for messages) and no equations. Its
//! expressions live in one [`Dag`]. Invariants:
//!
//! * every expression is defined over symbols of this model, and its unit is the one that its
//!   field requires;
//! * stages obey [`stage`]: a mass is no later than [`stage::PARAMETER`], a position no later than
//!   [`stage::POSITION`], and so on for every field, as its docs say;
//! * a pose comes after its parent in [`Model::poses`]; pose 0 is the ground;
//! * vectors and points have two components in the plane and three in space, along the
//!   ground's axes.

use lagrangian_symbolic::{Dag, Expr};

use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::SectionKind;
use crate::unit::Unit;
pub use crate::unit::{Compliance, ImpactLaw, ImpactOrder, Name, Painleve, Stages, Variable};

pub mod bounds;
pub mod charts;
pub mod circles;
pub mod element;
pub mod polygons;
mod published;
pub mod quaternion;
pub mod spheres;
mod tensor;

pub use published::*;

use bounds::Bound;
use charts::Charts;
use element::Element;
use polygons::Corner;
use quaternion::Quaternion;

/// When a value becomes known. Values of earlier stages can be computed once and reused.
pub mod stage {
    use lagrangian_symbolic::Stage;

    /// Known when the equations are derived.
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

/// A machine as the spec describes it, without its equations.
#[derive(Clone)]
pub struct Model<'d> {
    /// The graph that its expressions live in.
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
    /// Parameters that follow from others, in the order of their declaration; their formulas are already substituted
    /// into the expressions.
    pub derived_parameters: Vec<DerivedParameter<'d>>,
    /// Compile-time constants; their values are already substituted into the expressions.
    pub constants: Vec<Constant<'d>>,
    /// Generalized coordinates, in the order of `q`: those of the spec, then the time integrals of its first-order states.
    pub coordinates: Vec<Coordinate<'d>>,
    /// Values that the user sets while the machine runs.
    pub inputs: Vec<Input<'d>>,
    /// Facts that the simplifier may use and that a run checks.
    pub assumptions: Vec<Assumption<'d>>,
    /// Every pose that a frame or body is built from, parents first.
    pub poses: Vec<Pose<'d>>,
    /// The quaternions that turn frames, each once; no coordinate belongs to two of them.
    pub quaternions: Vec<Quaternion<'d>>,
    /// Named frames of reference.
    pub frames: Vec<Frame>,
    /// Rigid bodies and particles, followed by the rotors of `rotors`: bodies without mass that turn by an angle.
    pub bodies: Vec<Body<'d>>,
    /// Everything that contributes to the equations besides the inertia of the bodies: springs, gravity,
    /// forces, constraints, section by section.
    pub elements: Vec<Element<'d>>,
    /// This machine with every guide of `sliding` relaxed: a guided body, with everything built on
    /// its frame, can move off by extra coordinates, two for each guide in the plane and three in
    /// space, appended to the others. The equations of these coordinates give the normal reactions.
    /// It is `None` if nothing slides.
    pub relaxed: Option<Box<Model<'d>>>,
    /// Circles (in space spheres) that can touch.
    pub circles: Vec<Circle<'d>>,
    /// Unilateral contacts.
    pub contacts: Vec<Contact<'d>>,
    /// Coordinates that are approximated.
    pub approximations: Vec<Approximation>,
    /// Quantities to observe.
    pub outputs: Vec<Output<'d>>,
    /// The variables by which the accelerations are to be differentiated, each once, in the order of [`Variable`].
    pub derivatives: Vec<Variable>,
    /// The stages of the accelerations that are to be computed by functions of their own.
    pub stages: Stages,
    /// Where the spec asks for emitted code with the Taylor series of the motion, if it does.
    pub taylor: Option<Span>,
    /// Whether the program is to have the projection of states onto the constraints, for code in which runs project the ends of their steps.
    pub projects: bool,
    /// Points for which the spec names a second chart.
    pub charts: Vec<Charts>,
    /// This machine in the other charts, with the same coordinates in the same order except for the replaced ones; `None` if the spec
    /// names no other chart.
    pub cartesian: Option<Box<Model<'d>>>,
    /// The formulas of the caller that contain an angle of the other charts and have no meaning there: in the machine in the other
    /// charts, the errors that a run in them must report. In the coordinates of the spec they are valid.
    pub uncharted: Vec<Diagnostic>,
    /// The start values, coordinates and rates, that are kept when a start that violates the
    /// constraints is corrected; each once.
    pub kept: Vec<Variable>,
    /// The end of the fastest motion, in coordinates; may depend on parameters. Empty if the spec gives none.
    pub destination: Vec<Expr<'d>>,
    /// Published equations to compare with.
    pub published: Vec<Published<'d>>,
    /// Bounds that masses, coefficients and similar values must obey.
    pub bounds: Vec<Bound<'d>>,
    /// The section headings of the machine and its bases, each where it occurs first.
    pub sections: Vec<(SectionKind, Span)>,
}

impl<'d> Model<'d> {
    /// How a frame or a body is turned.
    pub fn rotation(&self, place: FrameOrBody) -> Rotation<'d> {
        match place {
            FrameOrBody::Frame(pose) => Rotation::Frame(pose),
            FrameOrBody::Body(body) => self.bodies[body].rotation,
        }
    }
}

impl Model<'_> {
    /// The heading of a section, for messages about the section as a whole.
    pub fn section(&self, kind: SectionKind) -> Option<Span> {
        let found = self.sections.iter().find(|(section, _)| *section == kind);
        found.map(|(_, span)| *span)
    }
}

/// Whether the machine moves in the plane or in space.
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

    /// The number of components of the normal reaction of a guide. In the plane it is one, along the normal; in space a
    /// guide can press in any direction across itself, and its reaction is a vector in ground axes.
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
    /// Its value in that unit, a function of parameters.
    pub value: Expr<'d>,
    /// Its name in the spec.
    pub span: Span,
}

/// A value that is substituted when the equations are derived.
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
    /// Its start value; may depend on parameters.
    pub start: Expr<'d>,
    /// Its rate at the start, 0 if the spec gives none; may depend on parameters.
    pub start_rate: Expr<'d>,
    /// `None` for a coordinate. A first-order state `s` is the rate of a coordinate on which nothing
    /// depends, its integral over time; `rate` is then `ds/dt`, a function of states, coordinates,
    /// rates, inputs and time.
    pub rate: Option<Expr<'d>>,
    /// The symbol of the coordinate.
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
    /// Its value if the user does not set it, a constant; 0 if the spec gives none.
    pub default: Expr<'d>,
    /// Its symbol.
    pub symbol: Expr<'d>,
    /// Its name in the spec.
    pub span: Span,
}

/// An assumption: `excess > 0`, or `excess ≥ 0`.
#[derive(Clone)]
pub struct Assumption<'d> {
    /// As the spec writes it.
    pub text: String,
    /// The greater side minus the smaller.
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
    /// The ground: its origin is 0, its axes are the ground axes.
    pub const GROUND: PoseId = PoseId(0);

    /// Its place in [`Model::poses`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Position and orientation of a frame, and the step that leads to it from its parent.
#[derive(Clone)]
pub struct Pose<'d> {
    /// The pose that it was made from; the ground is its own parent.
    pub parent: PoseId,
    /// The step from the parent to this pose.
    pub step: PoseChange<'d>,
    /// Its origin, in ground axes.
    pub origin: Vec<Expr<'d>>,
    /// Its axes: `axes[k]` is the k-th axis as a vector in ground axes.
    pub axes: Vec<Vec<Expr<'d>>>,
    /// The angle by which it is turned, in the plane: the sum of its turns. Zero in space.
    pub angle: Expr<'d>,
}

/// How a pose differs from its parent.
#[derive(Clone)]
pub enum PoseChange<'d> {
    /// No difference: the ground.
    Ground,
    /// A shift of the origin, in the parent's axes.
    Shift(Vec<Expr<'d>>),
    /// A turn about an axis (0, 1, 2 for x, y, z) of the frame itself; in the plane always 2.
    Turn {
        /// The axis.
        axis: usize,
        /// The angle.
        angle: Expr<'d>,
    },
    /// A rotation by the four coordinates of a quaternion, in space: see [`quaternion`].
    Quaternion([Expr<'d>; 4]),
}

/// A named frame of reference.
#[derive(Clone)]
pub struct Frame {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Its pose.
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
    /// The mass centre in the axes of a frame, if the spec gives it so: `arm.point(0, 0, l/2)`, or
    /// the origin of the frame. In space this form gives shorter equations of motion.
    pub local: Option<Local<'d>>,
    /// Its orientation.
    pub rotation: Rotation<'d>,
    /// The corners of the polygon that is drawn for it, in order, in the axes of its frame, or in its own axes from its
    /// mass centre; empty if the spec gives no outline.
    pub outline: Vec<Vec<Expr<'d>>>,
    /// Its name in the spec.
    pub span: Span,
    /// The field that places it: `at`, or `frame` if that is the only one.
    pub position_span: Span,
}

/// A point in the axes of a frame.
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
    /// None: rotation carries no kinetic energy.
    Particle,
    /// In the plane.
    Planar(Expr<'d>),
    /// In space, about the body's own axes: the symmetric tensor's `xx, yy, zz, xy, xz, yz`, signs
    /// included; a body given by three moments has zeros for the rest.
    Tensor([Expr<'d>; 6]),
}

/// Orientation of a body.
#[derive(Clone, Copy)]
pub enum Rotation<'d> {
    /// Not given; allowed for a particle.
    Unspecified,
    /// By an angle from the ground, in the plane.
    Angle(Expr<'d>),
    /// It turns with a frame.
    Frame(PoseId),
}

/// A frame or body: what a body slides on, what a circle is fixed to, or what a force acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameOrBody {
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
    pub on: FrameOrBody,
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
    /// The inside of another circle, by its index.
    Inside(usize),
    /// The outside of another circle, by its index.
    Outside(usize),
    /// The first axis of a frame, with the circle on the side of the second; in space the plane of its first two axes, with the
    /// sphere on the side of the third.
    Along(PoseId),
}

/// The largest number of unilateral contacts of a machine: 85 discs in a bowl, which have 255 coordinates, make 3655. Contacts with long formulas reach the bound on
/// the size of equations before.
pub const MOST_UNILATERAL: usize = 4000;

/// A unilateral contact: gap ≥ 0.
#[derive(Clone)]
pub struct Contact<'d> {
    /// Its name.
    pub name: Name,
    /// The two surfaces, or the gap and the slip velocity as expressions in coordinates.
    pub geometry: ContactGeometry<'d>,
    /// Its response when the gap closes.
    pub response: Response<'d>,
    /// Coefficient of friction; none if the contact is frictionless.
    pub friction: Option<Expr<'d>>,
    /// Coefficient of static friction, if it differs.
    pub static_friction: Option<Expr<'d>>,
    /// Coefficient of rolling resistance, a length in m; none if nothing resists rolling.
    pub rolling_resistance: Option<Expr<'d>>,
    /// Its name in the spec.
    pub span: Span,
}

impl Contact<'_> {
    /// Whether friction acts along two tangents, as in space.
    pub fn has_two_tangents(&self, space: Space) -> bool {
        let has_two = match &self.geometry {
            ContactGeometry::Circles(_) | ContactGeometry::Point { .. } => space == Space::Space,
            ContactGeometry::Corner(_) => false,
            ContactGeometry::Expressions { across, .. } => across.is_some(),
        };
        has_two && self.friction.is_some()
    }
}

/// The response of a contact when its gap closes.
#[derive(Clone, Copy)]
pub enum Response<'d> {
    /// Rigid: the gap stays ≥ 0, so there is an impact.
    Rigid {
        /// The impact law.
        law: ImpactLaw,
        /// Whether simultaneous impacts are solved together or one after the other.
        order: ImpactOrder,
        /// What happens if friction leaves no consistent motion (Painlevé's paradox).
        painleve: Painleve,
        /// Coefficients of restitution along the normal and along the tangent; the latter is 0 if it is not given.
        restitution: [Expr<'d>; 2],
    },
    /// Compliant: the contact deforms and presses by a force law.
    Compliant {
        /// The force law.
        law: Compliance,
        /// Its parameters, in SI units; the second is 0 if it has only one.
        parameters: [Expr<'d>; 2],
    },
}

impl<'d> Response<'d> {
    /// The two numbers of the response: coefficients of restitution, or parameters of a force law.
    pub fn coefficients(self) -> [Expr<'d>; 2] {
        match self {
            Response::Rigid { restitution, .. } => restitution,
            Response::Compliant { parameters, .. } => parameters,
        }
    }

    /// The impact law, if the contact is rigid.
    pub fn impact_law(self) -> Option<ImpactLaw> {
        match self {
            Response::Rigid { law, .. } => Some(law),
            Response::Compliant { .. } => None,
        }
    }

    /// The order of simultaneous impacts, if the contact is rigid.
    pub fn order(self) -> Option<ImpactOrder> {
        match self {
            Response::Rigid { order, .. } => Some(order),
            Response::Compliant { .. } => None,
        }
    }

    /// What happens if friction leaves no consistent motion (Painlevé's paradox).
    pub fn painleve(self) -> Painleve {
        match self {
            Response::Rigid { painleve, .. } => painleve,
            Response::Compliant { .. } => Painleve::Error,
        }
    }

    /// The force law, if the contact is compliant.
    pub fn compliance(self) -> Option<Compliance> {
        match self {
            Response::Rigid { .. } => None,
            Response::Compliant { law, .. } => Some(law),
        }
    }
}

/// How the geometry of a contact is given.
#[derive(Clone)]
pub enum ContactGeometry<'d> {
    /// Two circles.
    Circles(Touching),
    /// A point, which is a circle of radius 0, and the surface that it touches.
    Point {
        /// The point.
        point: Circle<'d>,
        /// The surface that it touches.
        surface: Surface,
    },
    /// A corner of a convex polygon and another convex polygon, in the plane.
    Corner(Corner<'d>),
    /// Expressions.
    Expressions {
        /// The gap, which stays ≥ 0.
        gap: Expr<'d>,
        /// The slip velocity.
        slip: Expr<'d>,
        /// In space, the slip velocity in a second direction, if friction acts in two.
        across: Option<Expr<'d>>,
    },
}

/// A coordinate that is approximated.
#[derive(Clone, Copy, Debug)]
pub struct Approximation {
    /// Its index.
    pub coordinate: usize,
    /// The kind of approximation.
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
