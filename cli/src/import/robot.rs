//! A robot as its file has it, whatever the format: links on joints, and what acts along these.

use super::number::Number;
use super::steps::Turns;
use super::tensor::Tensor;

/// A robot.
#[derive(Debug, Default)]
pub struct Robot {
    pub name: String,
    /// What the format is called, and what it calls a rigid part.
    pub format: &'static str,
    pub part: &'static str,
    pub links: Vec<Link>,
    pub joints: Vec<Joint>,
    /// What moves joints, from outside.
    pub drives: Vec<Drive>,
    /// What holds coordinates together, beyond the tree.
    pub ties: Vec<Tie>,
    /// The acceleration of gravity, where the file has one.
    pub gravity: Option<[Number; 3]>,
    /// What was left out because the call says so, and what has no part in the motion but is no geometry.
    pub left_out: Vec<String>,
    /// What the call wants to be left out, and is not there.
    pub unneeded: Vec<String>,
    /// What a user should know besides.
    pub warnings: Vec<String>,
}

/// A rigid body, or a frame without mass.
#[derive(Debug, Default)]
pub struct Link {
    pub name: String,
    /// None where there is no mass.
    pub inertial: Option<Inertial>,
    /// Whether it only stands between two joints of one part, and has no frame of its own.
    pub is_between: bool,
    /// Where it stands in the text.
    pub at: usize,
}

/// Mass, mass centre in the link's frame, and the tensor about it in axes that are turned.
#[derive(Debug)]
pub struct Inertial {
    pub mass: Number,
    pub xyz: [Number; 3],
    pub turns: Turns,
    pub tensor: Tensor,
    /// What a comment says of where the numbers are from.
    pub source: &'static str,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    Revolute,
    Continuous,
    Prismatic,
    #[default]
    Fixed,
    Floating,
    Planar,
    Spherical,
}

impl Kind {
    /// Whether it has one coordinate, which limits, damping and others are about.
    pub fn is_single(self) -> bool {
        matches!(self, Kind::Revolute | Kind::Continuous | Kind::Prismatic)
    }
}

/// What joins a link to its parent. The frame of the child is that of the parent, shifted by `xyz`, turned by `turns`, and moved by
/// the joint.
#[derive(Debug, Default)]
pub struct Joint {
    pub name: String,
    pub kind: Kind,
    /// What the format calls its kind.
    pub label: &'static str,
    pub parent: String,
    pub child: String,
    /// The parts on both sides as a comment names them.
    pub shown: [String; 2],
    pub xyz: [Number; 3],
    pub turns: Turns,
    pub axis: [f64; 3],
    pub damping: Number,
    pub friction: Number,
    /// The stiffness of a spring in the joint, and the value at which it is free.
    pub stiffness: Number,
    pub free_at: Number,
    /// The inertia that turns or slides with the joint's coordinate alone.
    pub armature: Number,
    /// The value at which the joint moves nothing, and with which it starts.
    pub reference: Number,
    /// Where a floating joint starts: a place, and three angles for given axes; of a spherical one the axes.
    pub start: Option<Start>,
    /// The value and the rate with which the file lets a joint with one coordinate start.
    pub home: Option<Number>,
    pub home_rate: Option<Number>,
    /// The least and the greatest value.
    pub range: Option<[Number; 2]>,
    /// Bounds of velocity and effort, soft limits: what a comment says.
    pub remarks: Vec<(&'static str, Number)>,
    pub mimic: Option<Mimic>,
    pub at: usize,
}

/// A pose in numbers.
#[derive(Clone, Debug)]
pub struct Start {
    pub xyz: [Number; 3],
    /// The axes as columns.
    pub axes: nalgebra::Matrix3<f64>,
}

/// A joint that follows another: multiplier times its value and offset.
#[derive(Debug)]
pub struct Mimic {
    pub joint: String,
    pub multiplier: Number,
    pub offset: Number,
    pub at: usize,
}

/// What moves a joint, by an input.
#[derive(Debug)]
pub struct Drive {
    pub name: String,
    /// The joint, by its place among all.
    pub joint: usize,
    /// How far the drive goes for each unit of the joint.
    pub gear: Number,
    pub law: Law,
    /// The inertia of what turns with the drive.
    pub inertia: Number,
    /// Its place among all actuators of the file, and what its input is as long as nobody sets it.
    pub number: usize,
    pub usual: Number,
}

/// The force of a drive, by its input u, and by s, which is the gear times the joint's value.
#[derive(Clone, Debug)]
pub enum Law {
    /// The input is the force.
    Force,
    /// k (u − s) − b ds/dt.
    Position { stiffness: Number, damping: Number },
    /// b (u − ds/dt).
    Rate { damping: Number },
    /// k u + c + l s + r ds/dt.
    Affine {
        gain: Number,
        constant: Number,
        of_length: Number,
        of_rate: Number,
    },
}

/// What holds coordinates together.
#[derive(Debug)]
pub struct Tie {
    pub name: String,
    pub kind: TieKind,
}

/// How.
#[derive(Debug)]
pub enum TieKind {
    /// q₁ − r₁ = Σ cᵢ (q₂ − r₂)ⁱ, with r what the coordinates are where the joints move nothing.
    Polynomial {
        follower: usize,
        leader: Option<usize>,
        coefficients: Vec<Number>,
    },
    /// A point of a link is one of another; with `axes` the second link's axes are these, as columns, in those of the first.
    Closing {
        anchors: Box<[Anchor; 2]>,
        axes: Option<nalgebra::Matrix3<f64>>,
    },
}

/// A point in a link's frame.
#[derive(Debug)]
pub struct Anchor {
    pub link: String,
    pub xyz: [Number; 3],
}
