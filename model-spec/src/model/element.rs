//! Elements: everything a machine has besides its bodies, and its contributions to the equations.
//!
//! A section of the language describes an element in the terms of an engineer. Here it has been reduced
//! to a small closed set of mechanical contributions: energies, dissipation, loads, gravity,
//! constraints, rolling and sliding. Equations, their proof, the printed chapter and the report are made
//! from these, and none of them knows sections. So a new section that consists of these contributions
//! needs no change outside its own file.

use lagrangian_symbolic::Expr;

use super::{FrameOrBody, Model, Name, Touching};
use crate::source::Span;
use crate::syntax::Section;
use crate::unit::Unit;

/// One item of a section that contributes to the equations: a spring, a force, a constraint.
#[derive(Clone, Debug)]
pub struct Element<'d> {
    /// The section that it belongs to, with the word for one of its items.
    pub section: &'static Section,
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// What it contributes to the equations.
    pub contributions: Vec<Contribution<'d>>,
    /// How a report draws it; none if there is nothing to draw.
    pub drawing: Option<Drawing<'d>>,
    /// Its name in the spec.
    pub span: Span,
}

/// The contribution of an element to the equations, one of a closed set.
#[derive(Clone, Debug)]
pub enum Contribution<'d> {
    /// Potential energy, eq. (E2), in J.
    Stored(Energy<'d>),
    /// Rayleigh's dissipation function, eq. (E3), in W.
    Dissipated(Energy<'d>),
    /// Applied forces and torques by their virtual work, eq. (E6).
    Load(Load<'d>),
    /// The acceleration of gravity, which acts on all bodies: a vector in ground axes, in m/s².
    Gravity(Vec<Expr<'d>>),
    /// An equation that always holds.
    Constraint(Constraint<'d>),
    /// Circles that touch and roll.
    Rolling(Rolling<'d>),
    /// A guided contact with Coulomb friction.
    Sliding(Sliding<'d>),
    /// Energy stored in first-order states, in J, as a function of these, coordinates, parameters and time: a part of E
    /// that enters only the energy balance.
    StateEnergy(Expr<'d>),
    /// Power lost by other means than dissipation, in W, which enters only the energy balance.
    PowerLoss(Expr<'d>),
}

/// A term of the potential energy, or of the dissipation function.
#[derive(Clone, Debug)]
pub enum Energy<'d> {
    /// `½ c x²` of a deformation `x`; as a dissipation `½ c ẋ²` of its rate.
    Quadratic(Deformation<'d>),
    /// A given function of positions and time or, as a dissipation, of velocities too.
    Given(Expr<'d>),
}

/// A deformation with its coefficient.
#[derive(Clone, Copy, Debug)]
pub struct Deformation<'d> {
    /// Stiffness or damping coefficient; no later than a parameter or time.
    pub coefficient: Expr<'d>,
    /// The deformation, of positions and time.
    pub measure: Expr<'d>,
    /// Whether it is an angle of twist and not a length.
    pub torsional: bool,
}

/// An applied force or torque.
#[derive(Clone, Debug)]
pub enum Load<'d> {
    /// A force at a point of the machine.
    Point {
        /// The point.
        at: Vec<Expr<'d>>,
        /// The force, in ground axes.
        force: Vec<Expr<'d>>,
    },
    /// A generalized force on a coordinate.
    Coordinate {
        /// The index of the coordinate.
        coordinate: usize,
        /// The generalized force.
        value: Expr<'d>,
    },
    /// A force along a length, or a torque about an angle: its work is the force times the change of that measure.
    Along {
        /// The length or angle that grows if the force is positive, a function of positions and time.
        measure: Expr<'d>,
        /// The force.
        force: Expr<'d>,
        /// Whether it is an angle and not a length.
        torsional: bool,
    },
    /// A torque on a body or a frame.
    Torque {
        /// Where it acts; a body has an angle or a frame.
        on: FrameOrBody,
        /// One component in the plane, three in ground axes in space.
        torque: Vec<Expr<'d>>,
    },
}

/// A bilateral constraint, `expression = 0`.
#[derive(Clone, Debug)]
pub struct Constraint<'d> {
    /// The name of its multiplier.
    pub name: Name,
    /// Left side minus right side; nonholonomic if it contains velocities.
    pub expression: Expr<'d>,
    /// The unit of both sides.
    pub unit: Unit,
    /// Its name in the spec.
    pub span: Span,
}

/// A circle that touches something and rolls on it.
#[derive(Clone, Debug)]
pub struct Rolling<'d> {
    /// The name from which those of its two constraints are derived.
    pub name: Name,
    /// The circle, and the surface on which it rolls.
    pub circles: Touching,
    /// The available coefficient of friction, a function of parameters. The motion does not depend on
    /// it: it only shows whether the rolling assumption is valid.
    pub friction: Option<Expr<'d>>,
    /// Its name in the spec.
    pub span: Span,
}

/// A guided contact whose normal reaction makes Coulomb friction.
#[derive(Clone, Debug)]
pub struct Sliding<'d> {
    /// The name of its reaction and friction.
    pub name: Name,
    /// The body that slides, by its index.
    pub body: usize,
    /// The frame or body on which it slides.
    pub on: FrameOrBody,
    /// The direction of sliding, as given; on a surface one of two tangents.
    pub direction: Vec<Expr<'d>>,
    /// The side on which the body is, as given; the direction turned left if none is given. For a surface its normal, as given.
    pub normal: Option<Vec<Expr<'d>>>,
    /// Which of the two tangents of a surface the direction is, in space; none for a line or a curve.
    pub tangent: Option<SurfaceTangent>,
    /// The coefficient of friction.
    pub friction: Expr<'d>,
    /// The coefficient of static friction, if it differs.
    pub static_friction: Option<Expr<'d>>,
    /// Its name in the spec.
    pub span: Span,
}

/// The tangents of a surface. Sliding on a surface is two contacts, one after the other, which obey one friction law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceTangent {
    /// The tangent with the name of the element.
    First,
    /// The tangent perpendicular to it, with `.across` after its name. The reaction belongs to the first.
    Second,
}

/// How a report draws an element.
#[derive(Clone, Debug)]
pub struct Drawing<'d> {
    /// The shape.
    pub shape: Shape,
    /// Its place.
    pub site: Site<'d>,
}

/// The shape of a drawn element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The zigzag of a spring.
    Coil,
    /// The cylinder and piston of a damper.
    Dashpot,
}

/// The place where an element is drawn.
#[derive(Clone, Debug)]
pub enum Site<'d> {
    /// From one point to the other, in ground axes.
    Between([Vec<Expr<'d>>; 2]),
    /// Where this stretch is recognized: between two points, or along the line of action on a body.
    Stretch(Expr<'d>),
    /// About the hinge that turns by this angle.
    Twist(Expr<'d>),
    /// About a point, in ground axes.
    At(Vec<Expr<'d>>),
}

impl<'d> Deformation<'d> {
    /// `½ c x²`.
    pub fn energy(&self) -> Expr<'d> {
        self.coefficient * self.measure.square() / 2
    }
}

impl<'d> Model<'d> {
    /// Every contribution with its element: element by element, each in the order of its own list.
    pub fn contributions(&self) -> impl Iterator<Item = (&Element<'d>, &Contribution<'d>)> {
        let all = self.elements.iter();
        all.flat_map(|element| element.contributions.iter().map(move |one| (element, one)))
    }

    /// Everything that stores energy, except gravity.
    pub fn stored(&self) -> impl Iterator<Item = &Energy<'d>> {
        self.contributions().filter_map(|(_, one)| one.stored())
    }

    /// Everything that dissipates energy, except friction.
    pub fn dissipated(&self) -> impl Iterator<Item = &Energy<'d>> {
        self.contributions().filter_map(|(_, one)| one.dissipated())
    }

    /// Applied forces and torques.
    pub fn loads(&self) -> impl Iterator<Item = &Load<'d>> {
        self.contributions().filter_map(|(_, one)| one.load())
    }

    /// The acceleration of gravity, in ground axes.
    pub fn gravity(&self) -> Option<&[Expr<'d>]> {
        self.contributions().find_map(|(_, one)| match one {
            Contribution::Gravity(gravity) => Some(&gravity[..]),
            _ => None,
        })
    }

    /// Bilateral constraints.
    pub fn constraints(&self) -> Vec<&Constraint<'d>> {
        let all = self.contributions().filter_map(|(_, one)| match one {
            Contribution::Constraint(constraint) => Some(constraint),
            _ => None,
        });
        all.collect()
    }

    /// Energies stored in first-order states.
    pub fn energies_of_states(&self) -> impl Iterator<Item = Expr<'d>> {
        self.contributions().filter_map(|(_, one)| match one {
            Contribution::StateEnergy(energy) => Some(*energy),
            _ => None,
        })
    }

    /// Powers lost by other means than dissipation.
    pub fn losses(&self) -> impl Iterator<Item = Expr<'d>> {
        self.contributions().filter_map(|(_, one)| match one {
            Contribution::PowerLoss(power) => Some(*power),
            _ => None,
        })
    }

    /// Circles that touch and roll.
    pub fn rolling(&self) -> Vec<&Rolling<'d>> {
        let all = self.contributions().filter_map(|(_, one)| match one {
            Contribution::Rolling(rolling) => Some(rolling),
            _ => None,
        });
        all.collect()
    }

    /// Guided contacts with Coulomb friction.
    pub fn sliding(&self) -> Vec<&Sliding<'d>> {
        let all = self.contributions().filter_map(|(_, one)| match one {
            Contribution::Sliding(sliding) => Some(sliding),
            _ => None,
        });
        all.collect()
    }
}

impl Sliding<'_> {
    /// Whether this is the second tangent of a surface.
    pub fn is_second(&self) -> bool {
        self.tangent == Some(SurfaceTangent::Second)
    }

    /// The name in the spec.
    pub fn name_in_spec(&self) -> String {
        let name = self.name.to_string();
        if self.is_second() {
            name.trim_end_matches(ACROSS).to_owned()
        } else {
            name
        }
    }
}

/// The suffix of the name of a second tangent.
pub const ACROSS: &str = ".across";

impl<'d> Element<'d> {
    /// Every expression in its contributions and its drawing, in a fixed order.
    pub fn expressions_mut(&mut self) -> Vec<&mut Expr<'d>> {
        let contributions = self.contributions.iter_mut();
        let mut all: Vec<_> = contributions
            .flat_map(Contribution::expressions_mut)
            .collect();
        match self.drawing.as_mut().map(|drawing| &mut drawing.site) {
            None => {}
            Some(Site::Between(ends)) => all.extend(ends.iter_mut().flatten()),
            Some(Site::Stretch(measure) | Site::Twist(measure)) => all.push(measure),
            Some(Site::At(point)) => all.extend(point),
        }
        all
    }
}

impl<'d> Contribution<'d> {
    /// The stored energy, if it is one.
    pub fn stored(&self) -> Option<&Energy<'d>> {
        match self {
            Contribution::Stored(energy) => Some(energy),
            _ => None,
        }
    }

    /// The dissipation, if it is one.
    pub fn dissipated(&self) -> Option<&Energy<'d>> {
        match self {
            Contribution::Dissipated(energy) => Some(energy),
            _ => None,
        }
    }

    /// The load, if it is one.
    pub fn load(&self) -> Option<&Load<'d>> {
        match self {
            Contribution::Load(load) => Some(load),
            _ => None,
        }
    }

    fn expressions_mut(&mut self) -> Vec<&mut Expr<'d>> {
        match self {
            Contribution::Stored(energy) | Contribution::Dissipated(energy) => match energy {
                Energy::Quadratic(one) => vec![&mut one.coefficient, &mut one.measure],
                Energy::Given(value) => vec![value],
            },
            Contribution::Load(Load::Point { at, force }) => at.iter_mut().chain(force).collect(),
            Contribution::Load(Load::Coordinate { value, .. }) => vec![value],
            Contribution::Load(Load::Along { measure, force, .. }) => vec![measure, force],
            Contribution::Load(Load::Torque { torque, .. }) => torque.iter_mut().collect(),
            Contribution::Gravity(gravity) => gravity.iter_mut().collect(),
            Contribution::StateEnergy(value) | Contribution::PowerLoss(value) => vec![value],
            Contribution::Constraint(constraint) => vec![&mut constraint.expression],
            Contribution::Rolling(rolling) => rolling.friction.iter_mut().collect(),
            Contribution::Sliding(sliding) => {
                let vectors = sliding.direction.iter_mut();
                let vectors = vectors.chain(sliding.normal.iter_mut().flatten());
                let coefficients = sliding.static_friction.iter_mut();
                let coefficients = std::iter::once(&mut sliding.friction).chain(coefficients);
                vectors.chain(coefficients).collect()
            }
        }
    }
}
