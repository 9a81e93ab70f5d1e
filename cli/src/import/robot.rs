//! A robot, independent of the file format: links on joints, and forces along these.

use super::number::Number;
use super::steps::Turns;
use super::tensor::Tensor;

/// A robot.
#[derive(Debug, Default)]
pub struct Robot {
    pub name: String,
    /// The name of the format, and its word for a rigid part.
    pub format: &'static str,
    pub part: &'static str,
    pub links: Vec<Link>,
    pub joints: Vec<Joint>,
    /// The actuators of joints.
    pub drives: Vec<Drive>,
    /// Constraints between coordinates besides the tree.
    pub ties: Vec<Tie>,
    /// The acceleration of gravity, if the file gives one.
    pub gravity: Option<[Number; 3]>,
    /// What was left out because the call says so, and other elements without effect on the motion except geometry.
    pub left_out: Vec<String>,
    /// Names that the call ignores but that do not occur.
    pub unneeded: Vec<String>,
    /// Other notes for the user.
    pub warnings: Vec<String>,
}

impl Robot {
    /// Notes what was left out, and which of the names that the call ignores do not occur: these elements with their counts, `motor` or
    /// `range of joint`.
    pub fn leave_out(&mut self, ignored: &[String], counts: Vec<(String, usize)>) {
        let is_unneeded = |name: &&String| counts.iter().all(|(what, _)| what != *name);
        self.unneeded = ignored.iter().filter(is_unneeded).cloned().collect();
        for (what, count) in counts {
            self.left_out.push(match (what.split_once(" of "), count) {
                (Some((what, of)), 1) => format!("{what} of 1 {of}"),
                (Some((what, of)), _) => format!("{what} of {count} {of}s"),
                (None, 1) => format!("1 element `{what}`"),
                (None, _) => format!("{count} elements `{what}`"),
            });
        }
    }
}

/// A rigid body, or a frame without mass.
#[derive(Debug, Default)]
pub struct Link {
    pub name: String,
    /// `None` for a link without mass.
    pub inertial: Option<Inertial>,
    /// Whether it is only an intermediate frame between two joints of one part.
    pub is_between: bool,
    /// Its position in the text.
    pub at: usize,
}

/// The mass, the mass centre in the link's frame, and the tensor about it in rotated axes.
#[derive(Debug)]
pub struct Inertial {
    pub mass: Number,
    pub xyz: [Number; 3],
    pub turns: Turns,
    pub tensor: Tensor,
    /// The source of the numbers, for a comment.
    pub source: &'static str,
}

/// The kind of motion of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JointKind {
    Revolute,
    Continuous,
    Prismatic,
    #[default]
    Fixed,
    Floating,
    Planar,
    Spherical,
}

impl JointKind {
    /// Whether it has one coordinate, so that limits, damping and the like apply.
    pub fn is_single(self) -> bool {
        matches!(
            self,
            JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic
        )
    }
}

/// A joint between a link and its parent. The frame of the child is that of the parent, displaced by `xyz`, rotated by `turns`, and
/// moved by the joint.
#[derive(Debug, Default)]
pub struct Joint {
    pub name: String,
    pub kind: JointKind,
    /// The name of its kind in the format.
    pub label: &'static str,
    pub parent: String,
    pub child: String,
    /// The names of the parts on both sides, for a comment.
    pub shown: [String; 2],
    pub xyz: [Number; 3],
    pub turns: Turns,
    pub axis: [f64; 3],
    pub damping: Number,
    pub friction: Number,
    /// The stiffness of a spring in the joint, and the value at which it is relaxed.
    pub stiffness: Number,
    pub free_at: Number,
    /// The inertia that moves with the joint's coordinate alone.
    pub armature: Number,
    /// The value at which the joint does not displace its link, and at which it starts.
    pub reference: Number,
    /// The start of a floating joint: a position, and three angles about given axes; for a spherical joint the axes.
    pub start: Option<Start>,
    /// The start value and rate that the file gives for a joint with one coordinate.
    pub home: Option<Number>,
    pub home_rate: Option<Number>,
    /// The least and the greatest value.
    pub range: Option<[Number; 2]>,
    /// Limits of velocity and effort, and soft limits, for a comment.
    pub remarks: Vec<(&'static str, Number)>,
    pub mimic: Option<Mimic>,
    pub at: usize,
}

/// A numerical pose.
#[derive(Clone, Debug)]
pub struct Start {
    pub xyz: [Number; 3],
    /// The axes as columns.
    pub axes: nalgebra::Matrix3<f64>,
}

/// A joint that follows another: its value is multiplier times the other's value plus offset.
#[derive(Debug)]
pub struct Mimic {
    pub joint: String,
    pub multiplier: Number,
    pub offset: Number,
    pub at: usize,
}

/// An actuator, which moves a joint by an input.
#[derive(Debug)]
pub struct Drive {
    pub name: String,
    /// The index of the joint.
    pub joint: usize,
    /// The transmission ratio: the motion of the actuator per unit of the joint.
    pub gear: Number,
    pub law: Law,
    /// The inertia of the parts that turn with the actuator.
    pub inertia: Number,
    /// Its index among all actuators of the file, and the default value of its input.
    pub number: usize,
    pub usual: Number,
}

/// The force of an actuator as a function of its input u and of s, which is the gear times the joint's value.
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

/// A constraint between coordinates.
#[derive(Debug)]
pub struct Tie {
    pub name: String,
    pub kind: TieKind,
}

/// The kind of a constraint.
#[derive(Debug)]
pub enum TieKind {
    /// q₁ − r₁ = Σ cᵢ (q₂ − r₂)ⁱ, where r are the values of the coordinates in the reference configuration.
    Polynomial {
        follower: usize,
        leader: Option<usize>,
        coefficients: Vec<Number>,
    },
    /// A point of a link coincides with one of another; with `axes`, the axes of the second link, as columns in
    /// those of the first, are these.
    Closing {
        anchors: Box<[Anchor; 2]>,
        axes: Option<nalgebra::Matrix3<f64>>,
        /// Which of its conditions, three for the points and three for the axes, depend on the values of joints; the others always
        /// hold.
        varies: [bool; 6],
    },
}

/// A point in a link's frame.
#[derive(Debug)]
pub struct Anchor {
    pub link: String,
    pub xyz: [Number; 3],
}
