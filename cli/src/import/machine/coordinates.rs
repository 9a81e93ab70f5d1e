//! The coordinates of joints, of one and several degrees of freedom, and those of the root.

use super::Writer;
use super::capital;
use crate::call::{Ball, Base, Limits};
use crate::import::faults::Faults;
use crate::import::names::quoted;
use crate::import::number::Number;
use crate::import::robot::{Joint, JointKind, Start};
use crate::import::steps::{self, AXES, conjugated, slide, straightened, turn};

impl Writer<'_> {
    /// Adds coordinates and definitions, and the motions that they cause.
    pub(super) fn coordinates(&mut self, faults: &mut Faults) {
        if self.call.base == Base::Floating {
            let link = &self.robot.links[self.tree.root].name;
            let part = capital(self.robot.part);
            let comment = format!("{part} {}, which is attached to nothing.", quoted(link));
            self.root_motion = self.floating(link, comment, "link", None);
        }
        for (index, joint) in self.joints() {
            let [parent, child] = joint.shown.each_ref().map(|name| quoted(name));
            let (kind, part) = (joint.label, self.robot.part);
            let name = quoted(&joint.name);
            let mut comment = format!("Joint {name}, {kind}, {part} {child} on {part} {parent}");
            comment.push_str(&joint_comment(joint));
            comment.push('.');
            self.motion[index] = match joint.kind {
                JointKind::Fixed => Vec::new(),
                JointKind::Floating => {
                    self.floating(&joint.name, comment, "joint", joint.start.as_ref())
                }
                JointKind::Spherical => {
                    let ball = self.call.ball.unwrap_or(Ball::Xyz);
                    self.ball(&joint.name, comment, ball, joint.start.as_ref())
                }
                JointKind::Planar => self.planar(joint, comment),
                JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic => {
                    self.single(index, joint, comment, faults);
                    continue;
                }
            };
        }
        self.followers();
        for (index, joint) in self.joints() {
            if joint.kind.is_single() {
                let value = match self.reference_of[index].as_str() {
                    "" => self.value_of[index].clone(),
                    reference => format!("({} - {reference})", self.value_of[index]),
                };
                self.motion[index] = match joint.kind {
                    JointKind::Prismatic => vec![slide(&joint.axis, &value)],
                    _ => turn(&joint.axis, &value),
                };
            }
        }
    }

    /// Adds the coordinates of a joint with several.
    pub(super) fn several(
        &mut self,
        name: &str,
        comment: String,
        kind: &str,
        list: &[(&str, &str)],
        starts: Option<&[String]>,
    ) -> Vec<String> {
        let mut taken = Vec::new();
        let mut entries = Vec::new();
        for (place, (suffix, unit)) in list.iter().enumerate() {
            let coordinate = self.values.take(&format!("{name}_{suffix}"), kind);
            let start = match starts {
                Some(starts) if starts[place] != "0" => format!(" = {}", starts[place]),
                _ => String::new(),
            };
            entries.push(format!("{coordinate}: {unit}{start}"));
            taken.push(coordinate);
        }
        self.text.add("coordinates", Some(comment), entries);
        taken
    }

    pub(super) fn floating(
        &mut self,
        name: &str,
        comment: String,
        kind: &str,
        start: Option<&Start>,
    ) -> Vec<String> {
        let place = [("x", "m"), ("y", "m"), ("z", "m")];
        let from = start.map(|start| start.xyz.each_ref().map(Number::to_string));
        let from = from.as_ref().map(|from| &from[..]);
        let q = self.several(name, comment, kind, &place, from);
        let mut steps = vec![format!(".shift({}, {}, {})", q[0], q[1], q[2])];
        let ball = self.call.ball.unwrap_or(Ball::Zyx);
        let coordinates = match ball {
            Ball::Quaternion => "quaternion",
            Ball::Xyz | Ball::Zyx | Ball::Zxz => "angles",
        };
        let angles = format!("The {coordinates} of {kind} {}.", quoted(name));
        steps.extend(self.ball(name, angles, ball, start));
        steps
    }

    /// Three successive angles, the second and third about axes turned by those before, or a quaternion.
    pub(super) fn ball(
        &mut self,
        name: &str,
        comment: String,
        ball: Ball,
        start: Option<&Start>,
    ) -> Vec<String> {
        let list = match ball {
            Ball::Xyz => [("about_x", "x"), ("about_y", "y"), ("about_z", "z")],
            Ball::Zyx => [("yaw", "z"), ("pitch", "y"), ("roll", "x")],
            Ball::Zxz => [("precession", "z"), ("nutation", "x"), ("spin", "z")],
            Ball::Quaternion => return self.quaternion(name, comment, start),
        };
        let angles = list.map(|(suffix, _)| (suffix, "rad"));
        let from = start.map(|start| {
            let angles = match ball {
                Ball::Xyz => steps::angles(&start.axes, [0, 1, 2]),
                Ball::Zyx => steps::angles(&start.axes, [2, 1, 0]),
                Ball::Zxz | Ball::Quaternion => steps::angles(&start.axes, [2, 0, 2]),
            };
            angles.map(|angle| angle.to_string())
        });
        let from = from.as_ref().map(|from| &from[..]);
        let q = self.several(name, comment, "joint", &angles, from);
        self.warnings.push(match ball {
            Ball::Xyz | Ball::Zyx => {
                format!("`{}` is singular at 90° to either side; --ball selects other angles", q[1])
            }
            Ball::Zxz | Ball::Quaternion => format!(
                "`{}` is singular at 0, where it starts, and at 180°: give it a start value, or select other angles by --ball",
                q[1]
            ),
        });
        let step = |((_, axis), q): (&(&str, &str), &String)| format!(".turn({axis}, {q})");
        list.iter().zip(&q).map(step).collect()
    }

    /// A quaternion, which has no singularity.
    pub(super) fn quaternion(
        &mut self,
        name: &str,
        comment: String,
        start: Option<&Start>,
    ) -> Vec<String> {
        let list = [("e0", "1"), ("e1", "1"), ("e2", "1"), ("e3", "1")];
        let unturned = ["1", "0", "0", "0"].map(str::to_owned);
        let from = start.map_or(unturned, |start| {
            steps::quaternion(&start.axes).map(|x| Number::computed(x).to_string())
        });
        let e = self.several(name, comment, "joint", &list, Some(&from));
        vec![format!(".turn({})", e.join(", "))]
    }

    /// Two displacements in the plane orthogonal to the axis, and the rotation about it.
    pub(super) fn planar(&mut self, joint: &Joint, comment: String) -> Vec<String> {
        let (there, axis, sign) = straightened(&joint.axis);
        let across = match axis {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        };
        let [first, second] = if there.is_empty() {
            across.map(|axis| AXES[axis])
        } else {
            // Along the axes of a frame that is aligned with the plane.
            ["u", "v"]
        };
        let list = [(first, "m"), (second, "m"), ("angle", "rad")];
        let q = self.several(&joint.name, comment, "joint", &list, None);
        let mut shift = ["0"; 3];
        shift[across[0]] = &q[0];
        shift[across[1]] = &q[1];
        let shift = format!(".shift({}, {}, {})", shift[0], shift[1], shift[2]);
        let turn = format!(".turn({}, {sign}{})", AXES[axis], q[2]);
        conjugated(&there, vec![shift, turn])
    }

    /// The coordinate of a joint with one, unless it follows another.
    pub(super) fn single(
        &mut self,
        index: usize,
        joint: &Joint,
        comment: String,
        faults: &mut Faults,
    ) {
        let unit = unit_of(joint);
        self.value_of[index] = self.values.take(&joint.name, "joint");
        if self.tree.leader[index].is_some() {
            return;
        }
        let name = self.value_of[index].clone();
        if !joint.reference.is_zero() {
            let mut entries = Vec::new();
            let reference = measured(joint, &joint.reference);
            self.reference_of[index] =
                self.parameter(&mut entries, &format!("{name}_ref"), unit, &reference);
            let comment = format!(
                "Joint {}: its reference value, at which nothing is displaced.",
                quoted(&joint.name)
            );
            self.text.add("parameters", Some(comment), entries);
        }
        let from = joint.reference.value;
        let start = match (&joint.range, self.call.limits) {
            (Some([lower, upper]), Limits::Assume | Limits::Stop) => {
                if lower.value >= upper.value {
                    let name = quoted(&joint.name);
                    faults.add(
                        joint.at,
                        format!("the limits of joint {name} leave it no range"),
                    );
                }
                let bound = match () {
                    () if lower.value > from => Some(lower),
                    () if upper.value < from => Some(upper),
                    () => None,
                };
                bound.map(|bound| measured(joint, bound))
            }
            _ => None,
        };
        let reference = (from != 0.0).then(|| measured(joint, &joint.reference));
        // A start given by the file takes precedence.
        let home = joint.home.as_ref().map(|home| measured(joint, home));
        let start = home.or(start).or(reference);
        let start = start.map(|start| format!(" = {start}"));
        let mut entry = format!("{name}: {unit}{}", start.unwrap_or_default());
        if let Some(rate) = joint.home_rate.as_ref().filter(|rate| !rate.is_zero()) {
            entry.push_str(&format!(
                ", der({name}): {unit}/s = {}",
                measured(joint, rate)
            ));
        }
        self.text.add("coordinates", Some(comment), vec![entry]);
    }
}

/// The unit of a joint's coordinate.
pub(super) fn unit_of(joint: &Joint) -> &'static str {
    match joint.kind {
        JointKind::Prismatic => "m",
        _ => "rad",
    }
}

/// A joint value in the notation of a spec.
pub(super) fn measured(joint: &Joint, value: &Number) -> String {
    match joint.kind {
        JointKind::Prismatic => value.to_string(),
        _ => value.in_radians(),
    }
}

/// The text of a joint's comment: its range, and limits of velocity and effort.
pub(super) fn joint_comment(joint: &Joint) -> String {
    let (angle, force) = match joint.kind {
        JointKind::Prismatic => ("m", "N"),
        _ => ("rad", "N*m"),
    };
    let mut remarks = String::new();
    if let Some([lower, upper]) = &joint.range {
        remarks = format!("; between {lower} and {upper} {angle}");
    }
    for (name, number) in &joint.remarks {
        remarks.push_str(&match *name {
            "velocity" => format!("; velocity up to {number} {angle}/s"),
            "effort" => format!("; effort up to {number} {force}"),
            "acceleration" | "deceleration" => format!("; {name} up to {number} {angle}/s^2"),
            "jerk" => format!("; jerk up to {number} {angle}/s^3"),
            "soft_lower_limit" => format!("; the safety controller begins at {number} {angle}"),
            "soft_upper_limit" => format!("; the safety controller ends at {number} {angle}"),
            name => format!("; {name} of the safety controller {number}"),
        });
    }
    remarks
}
