//! Converts a robot to a machine: joints become coordinates, links become frames and bodies.

use nalgebra::Matrix3;

use super::faults::Faults;
use super::names::{self, Names, quoted};
use super::number::{Angle, Number};
use super::robot::{Anchor, Drive, Inertial, Joint, JointKind, Law, Robot, Start, TieKind};
use super::steps::{self, AXES, conjugated, slide, straightened, turn};
use super::tensor;
use super::text::{self, Text};
use super::tree::{self, Tree};
use crate::call::{Ball, Base, Friction, Import, Limits};
use crate::diagnostics::counted;

/// The sections in the order in which they are written. Gravity comes after the bodies.
const SECTIONS: [&str; 14] = [
    "parameters",
    "coordinates",
    "inputs",
    "define",
    "assume",
    "frames",
    "bodies",
    "rotors",
    "springs",
    "dampers",
    "forces",
    "constraints",
    "dissipations",
    "contacts",
];

/// The spec, with notes.
pub struct Machine {
    pub name: String,
    pub text: String,
    /// The numbers of its coordinates, bodies and parameters.
    pub counts: [usize; 3],
    pub warnings: Vec<String>,
}

/// Writes the machine of a robot, unless there are errors.
pub fn write(robot: &Robot, file: &str, call: &Import, faults: &mut Faults) -> Option<Machine> {
    let tree = tree::build(robot, faults)?;
    let mut writer = Writer::new(robot, &tree, call);
    writer.drop_massless(faults);
    writer.find_moving();
    writer.check_friction(faults);
    if !faults.is_empty() {
        return None;
    }
    writer.coordinates(faults);
    writer.frames();
    writer.bodies();
    writer.along_joints(faults);
    writer.drives();
    writer.ties();
    if faults.is_empty() && writer.text.count("coordinates") == 0 {
        faults.add(
            0,
            "nothing moves: no joint of the robot moves a link with mass",
        );
    }
    faults.is_empty().then(|| writer.finish(file))
}

struct Writer<'a> {
    robot: &'a Robot,
    tree: &'a Tree,
    call: &'a Import,
    text: Text,
    /// The names of parameters, coordinates and definitions.
    values: Names,
    gravity: String,
    /// For each joint with one coordinate its value in formulas: the coordinate, or the expression that follows it.
    value_of: Vec<String>,
    /// Its value at which the joint does not displace its link; empty if that is 0.
    reference_of: Vec<String>,
    /// The coordinate that it follows, and the factor; for a joint that follows none its own coordinate and
    /// an empty factor.
    coordinate_of: Vec<(usize, String)>,
    /// The steps by which a joint moves its link, from frame to frame, without the joint's origin.
    motion: Vec<Vec<String>>,
    /// The motion of the root.
    root_motion: Vec<String>,
    /// The names of the links in the spec.
    link_names: Vec<String>,
    /// The name of the frame in which each link is at rest.
    frame_of: Vec<String>,
    /// Joints that are left out, together with everything attached to them.
    is_dropped: Vec<bool>,
    /// Whether a link moves.
    is_moving: Vec<bool>,
    warnings: Vec<String>,
}

impl<'a> Writer<'a> {
    fn new(robot: &'a Robot, tree: &'a Tree, call: &'a Import) -> Writer<'a> {
        let mut values = Names::default();
        Writer {
            gravity: values.keep("g"),
            robot,
            tree,
            call,
            text: Text::new(&SECTIONS),
            values,
            value_of: vec![String::new(); robot.joints.len()],
            reference_of: vec![String::new(); robot.joints.len()],
            coordinate_of: (0..robot.joints.len())
                .map(|joint| (joint, String::new()))
                .collect(),
            motion: vec![Vec::new(); robot.joints.len()],
            root_motion: Vec::new(),
            link_names: vec![String::new(); robot.links.len()],
            frame_of: vec![String::new(); robot.links.len()],
            is_dropped: vec![false; robot.joints.len()],
            is_moving: vec![false; robot.links.len()],
            warnings: Vec::new(),
        }
    }

    /// The joints that are written, each after its parent.
    fn joints(&self) -> impl Iterator<Item = (usize, &'a Joint)> + use<'a> {
        let (order, joints) = (&self.tree.order, &self.robot.joints);
        let is_kept = |joint: &&usize| !self.is_dropped[**joint];
        let remaining: Vec<usize> = order.iter().filter(is_kept).copied().collect();
        remaining
            .into_iter()
            .map(move |joint| (joint, &joints[joint]))
    }

    /// Coordinates that move no mass have no acceleration: they are refused, or left out with everything attached to them.
    fn drop_massless(&mut self, faults: &mut Faults) {
        let (robot, tree) = (self.robot, self.tree);
        let heavy = tree.is_heavy(&robot.links);
        if self.call.base == Base::Floating && !heavy[tree.root] {
            faults.add(0, "no link of the robot has mass");
        }
        // What moves with a coordinate: the joint's own links, and those of joints that follow it.
        let mut moves_mass = vec![false; robot.joints.len()];
        for &joint in &tree.order {
            moves_mass[tree.first_leader(joint)] |= heavy[tree.child[joint]];
        }
        for &joint in &tree.order {
            let is_fixed = robot.joints[joint].kind == JointKind::Fixed;
            if is_fixed || moves_mass[tree.first_leader(joint)] {
                continue;
            }
            let name = quoted(&robot.joints[joint].name);
            if self.call.drop_massless {
                self.is_dropped[joint] = true;
                let attached = quoted(&robot.links[tree.child[joint]].name);
                self.warnings.push(format!(
                    "joint {name} moves no mass: it is left out, with link {attached} and everything attached to it"
                ));
            } else if tree.leader[joint].is_none() {
                let link = quoted(&robot.links[tree.child[joint]].name);
                faults.add(
                    robot.joints[joint].at,
                    format!(
                        "joint {name} moves no mass, so its acceleration is not determined: give link {link} an `inertial`, make the \
                         joint `fixed`, or leave it out with --drop-massless"
                    ),
                );
            }
        }
        // Without a joint everything beyond it is left out too.
        let mut is_gone = vec![false; robot.links.len()];
        for &joint in &tree.order {
            self.is_dropped[joint] |= is_gone[tree.parent[joint]];
            is_gone[tree.child[joint]] = self.is_dropped[joint];
        }
        for (index, joint) in self.joints() {
            if let (Some(mimic), Some(leader)) = (&joint.mimic, tree.leader[index])
                && self.is_dropped[leader]
            {
                let (follower, leader) = (quoted(&joint.name), quoted(&mimic.joint));
                let message = format!(
                    "joint {follower} mimics {leader}, which is attached to a joint that moves no mass and is left out"
                );
                faults.add(mimic.at, message);
            }
        }
    }

    fn find_moving(&mut self) {
        self.is_moving[self.tree.root] = self.call.base == Base::Floating;
        for (index, joint) in self.joints() {
            let is_carried = self.is_moving[self.tree.parent[index]];
            self.is_moving[self.tree.child[index]] = is_carried || joint.kind != JointKind::Fixed;
        }
    }

    /// Sticking is not a function of coordinates and rates alone, so Coulomb friction is not left out silently.
    fn check_friction(&self, faults: &mut Faults) {
        if self.call.friction.is_some() {
            return;
        }
        for (_, joint) in self.joints() {
            if joint.kind.is_single() && !joint.friction.is_zero() {
                let name = quoted(&joint.name);
                faults.add(
                    joint.at,
                    format!(
                        "joint {name} has friction, but there is no normal force from which to determine whether it sticks: `--friction \
                         none` leaves it out, `--friction smooth=1e-3` makes it f·q̇/√(q̇² + ε²)"
                    ),
                );
            }
        }
    }

    /// Adds a parameter; returns its name in formulas.
    fn parameter(
        &mut self,
        entries: &mut Vec<String>,
        name: &str,
        unit: &str,
        value: &str,
    ) -> String {
        let name = self.values.take(name, "value");
        entries.push(format!("{name}: {unit} = {value}"));
        name
    }

    /// A vector of lengths; nonzero entries become parameters.
    fn lengths(&mut self, entries: &mut Vec<String>, name: &str, xyz: &[Number; 3]) -> [String; 3] {
        std::array::from_fn(|axis| {
            if xyz[axis].is_zero() {
                "0".to_owned()
            } else {
                let name = format!("{name}_{}", AXES[axis]);
                self.parameter(entries, &name, "m", &xyz[axis].to_string())
            }
        })
    }

    /// Adds coordinates and definitions, and the motions that they cause.
    fn coordinates(&mut self, faults: &mut Faults) {
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
    fn several(
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

    fn floating(
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
    fn ball(
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
    fn quaternion(&mut self, name: &str, comment: String, start: Option<&Start>) -> Vec<String> {
        let list = [("e0", "1"), ("e1", "1"), ("e2", "1"), ("e3", "1")];
        let unturned = ["1", "0", "0", "0"].map(str::to_owned);
        let from = start.map_or(unturned, |start| {
            steps::quaternion(&start.axes).map(|x| Number::computed(x).to_string())
        });
        let e = self.several(name, comment, "joint", &list, Some(&from));
        vec![format!(".turn({})", e.join(", "))]
    }

    /// Two displacements in the plane orthogonal to the axis, and the rotation about it.
    fn planar(&mut self, joint: &Joint, comment: String) -> Vec<String> {
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
    fn single(&mut self, index: usize, joint: &Joint, comment: String, faults: &mut Faults) {
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

    /// Adds definitions for joints that follow a coordinate.
    fn followers(&mut self) {
        for (index, joint) in self.joints() {
            let (Some(mimic), Some(leader)) = (&joint.mimic, self.tree.leader[index]) else {
                continue;
            };
            let name = self.value_of[index].clone();
            let mut entries = Vec::new();
            let [own_unit, leader_unit] = [joint, &self.robot.joints[leader]].map(unit_of);
            let mut value = self.value_of[leader].clone();
            let is_alike = own_unit == leader_unit;
            let (coordinate, mut factor) = self.coordinate_of[leader].clone();
            if is_alike && mimic.multiplier.value == -1.0 {
                value = format!("-{value}");
                factor.insert_str(0, "-1*");
            } else if !is_alike || mimic.multiplier.value != 1.0 {
                let unit = if is_alike {
                    "1".to_owned()
                } else {
                    format!("{own_unit}/{leader_unit}")
                };
                let text = mimic.multiplier.to_string();
                let multiplier =
                    self.parameter(&mut entries, &format!("{name}_multiplier"), &unit, &text);
                value = format!("{multiplier}*{value}");
                factor.insert_str(0, &format!("{multiplier}*"));
            }
            self.coordinate_of[index] = (coordinate, factor);
            if !mimic.offset.is_zero() {
                let offset = measured(joint, &mimic.offset);
                let offset_name = format!("{name}_offset");
                let offset = self.parameter(&mut entries, &offset_name, own_unit, &offset);
                value = format!("{value} + {offset}");
            }
            let comment = format!(
                "Joint {}: how it follows {}.",
                quoted(&joint.name),
                quoted(&mimic.joint)
            );
            self.text.add("parameters", Some(comment), entries);
            let comment = format!(
                "Joint {}, {}, follows {}{}.",
                quoted(&joint.name),
                joint.label,
                quoted(&mimic.joint),
                joint_comment(joint)
            );
            self.text
                .add("define", Some(comment), vec![format!("{name} = {value}")]);
        }
    }

    /// Adds a frame for each link that is turned or displaced relative to its parent.
    fn frames(&mut self) {
        let links = &self.robot.links;
        let mut names = Names::default();
        // Links on which other frames and bodies are based; others are marked by an underscore.
        let mut has_frame = vec![false; links.len()];
        let mut stands_on: Vec<usize> = (0..links.len()).collect();
        let mut is_used = vec![false; links.len()];
        let is_body = |writer: &Writer<'_>, link: usize| {
            writer.is_moving[link] && links[link].inertial.is_some()
        };
        let root = self.tree.root;
        has_frame[root] = !self.root_motion.is_empty();
        is_used[root] = is_body(self, root);
        // Whether any steps lead to an intermediate link between two joints.
        let mut is_moved = vec![false; links.len()];
        for (index, joint) in self.joints() {
            let (parent, child) = (self.tree.parent[index], self.tree.child[index]);
            let is_there = joint.turns.is_empty() && joint.xyz.iter().all(Number::is_zero);
            let is_apart = !is_there || !self.motion[index].is_empty() || is_moved[parent];
            if links[child].is_between {
                stands_on[child] = stands_on[parent];
                is_moved[child] = is_apart;
                continue;
            }
            has_frame[child] = is_apart;
            if !has_frame[child] {
                stands_on[child] = stands_on[parent];
            } else {
                is_used[stands_on[parent]] = true;
            }
            is_used[stands_on[child]] |= is_body(self, child);
        }
        let part = self.robot.part;
        let name = |names: &mut Names, link: usize| {
            let is_marked = has_frame[link] && !is_used[link];
            let mark = if is_marked { "_" } else { "" };
            names.take(&format!("{mark}{}", links[link].name), part)
        };
        self.link_names[root] = name(&mut names, root);
        self.frame_of[root] = if has_frame[root] {
            self.link_names[root].clone()
        } else {
            "ground".to_owned()
        };
        if has_frame[root] {
            let frame = text::frame(&self.link_names[root], "ground", &self.root_motion);
            self.text.add("frames", None, vec![frame]);
        }
        // The steps from the frame of a link to the intermediate links after it.
        let mut leading = vec![Vec::new(); links.len()];
        for (index, joint) in self.joints() {
            let (parent, child) = (self.tree.parent[index], self.tree.child[index]);
            let base = self.frame_of[parent].clone();
            let mut steps = leading[parent].clone();
            let mut entries = Vec::new();
            let origin = format!("{}_origin", joint.name);
            let [x, y, z] = self.lengths(&mut entries, &origin, &joint.xyz);
            if !entries.is_empty() {
                steps.push(format!(".shift({x}, {y}, {z})"));
            }
            let comment = format!("Joint {}: where its origin is.", quoted(&joint.name));
            self.text.add("parameters", Some(comment), entries);
            let turn = |(axis, angle): &(usize, Angle)| format!(".turn({}, {angle})", AXES[*axis]);
            steps.extend(joint.turns.iter().map(turn));
            steps.extend(std::mem::take(&mut self.motion[index]));
            if links[child].is_between {
                self.frame_of[child] = base;
                leading[child] = steps;
                continue;
            }
            self.link_names[child] = name(&mut names, child);
            if !has_frame[child] {
                self.frame_of[child] = base;
                continue;
            }
            let frame = text::frame(&self.link_names[child], &base, &steps);
            self.text.add("frames", None, vec![frame]);
            self.frame_of[child] = self.link_names[child].clone();
        }
    }

    /// Adds the bodies: links with mass that move.
    fn bodies(&mut self) {
        let mut links = vec![(self.tree.root, None)];
        links.extend(
            self.joints()
                .map(|(index, joint)| (self.tree.child[index], Some(joint))),
        );
        let mut resting = Vec::new();
        for (link, joint) in links {
            let Some(inertial) = &self.robot.links[link].inertial else {
                continue;
            };
            if self.is_moving[link] {
                self.body(link, inertial, joint)
            } else {
                resting.push(quoted(&self.robot.links[link].name))
            }
        }
        if !resting.is_empty() {
            let many = resting.len() > 1;
            let (several, are, masses) = if many {
                ("s", "are", "their masses are")
            } else {
                ("", "is", "its mass is")
            };
            let part = match (self.robot.part, many) {
                ("body", true) => "bodie",
                (part, _) => part,
            };
            let help = match self.robot.gravity {
                None => "; with --base floating the robot is not fixed to the ground",
                Some(_) => "",
            };
            self.warnings.push(format!(
                "{part}{several} {} {are} fixed to the ground, so {masses} left out{help}",
                resting.join(", ")
            ));
        }
    }

    fn body(&mut self, link: usize, inertial: &Inertial, joint: Option<&Joint>) {
        let Inertial {
            mass,
            xyz,
            turns,
            tensor,
            source,
        } = inertial;
        let name = self.link_names[link].clone();
        let frame = self.frame_of[link].clone();
        let mut entries = Vec::new();
        let mass = self.parameter(
            &mut entries,
            &format!("{name}_mass"),
            "kg",
            &mass.to_string(),
        );
        let has_tensor = tensor.iter().any(|entry| !entry.is_zero());
        let [x, y, z] = self.lengths(&mut entries, &format!("{name}_com"), xyz);
        let is_centred = xyz.iter().all(Number::is_zero);
        let place = if is_centred {
            format!("{frame}.origin")
        } else {
            format!("{frame}.point({x}, {y}, {z})")
        };
        let mut parts = vec![format!("mass: {mass}")];
        if has_tensor {
            let turned = tensor::rotated(tensor, turns);
            let labels = ["Ixx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz"];
            let inertia: Vec<String> = labels
                .iter()
                .zip(&turned)
                .map(|(label, entry)| {
                    if entry.is_zero() {
                        "0".to_owned()
                    } else {
                        let name = format!("{name}_{label}");
                        self.parameter(&mut entries, &name, "kg*m^2", &entry.to_string())
                    }
                })
                .collect();
            let has_products = inertia[3..].iter().any(|entry| entry != "0");
            let shown = if has_products { 6 } else { 3 };
            parts.push(format!("inertia: ({})", inertia[..shown].join(", ")));
            parts.push(format!("frame: {frame}"));
        }
        if !has_tensor || !is_centred {
            parts.push(format!("at: {place}"));
        }
        let comment = if has_tensor {
            match self.robot.part {
                "link" => "mass, mass centre, and tensor of inertia about it in the link's axes",
                _ => "mass, mass centre, and tensor of inertia about it in the body's axes",
            }
        } else {
            "mass and mass centre"
        };
        let label = quoted(&self.robot.links[link].name);
        let (part, source) = (
            capital(self.robot.part),
            if has_tensor { *source } else { "" },
        );
        let comment = format!("{part} {label}: {comment}{source}.");
        self.text.add("parameters", Some(comment), entries);
        let comment = match joint {
            Some(joint) => format!("{part} {label}, held by joint {}.", quoted(&joint.name)),
            None => format!("{part} {label}."),
        };
        self.text
            .add("bodies", Some(comment), vec![text::body(&name, &parts)]);
    }

    /// Adds dampers, friction and stops.
    fn along_joints(&mut self, faults: &mut Faults) {
        let mut left_out = Vec::new();
        let mut limited = 0;
        let [mut smoothing, mut restitution] = [None, None].map(|none: Option<String>| none);
        let mut smoothing_of_slides = None;
        for (index, joint) in self.joints().filter(|(_, joint)| joint.kind.is_single()) {
            let value = self.value_of[index].clone();
            let is_turning = joint.kind != JointKind::Prismatic;
            let mut entries = Vec::new();
            if !joint.stiffness.is_zero() {
                let unit = if is_turning { "N*m" } else { "N/m" };
                let text = joint.stiffness.to_string();
                let stiffness =
                    self.parameter(&mut entries, &format!("{value}_stiffness"), unit, &text);
                let stretch = if joint.free_at.is_zero() {
                    value.clone()
                } else {
                    let (name, text) =
                        (format!("{value}_free_at"), measured(joint, &joint.free_at));
                    let free = self.parameter(&mut entries, &name, unit_of(joint), &text);
                    format!("{value} - {free}")
                };
                let spring = format!("{value} {{ stiffness: {stiffness}, stretch: {stretch} }}");
                self.text.add("springs", None, vec![spring]);
            }
            if !joint.armature.is_zero() {
                let unit = if is_turning { "kg*m^2" } else { "kg" };
                let text = joint.armature.to_string();
                let inertia =
                    self.parameter(&mut entries, &format!("{value}_armature"), unit, &text);
                let rotor = format!("{value} {{ inertia: {inertia}, angle: {value} }}");
                self.text.add("rotors", None, vec![rotor]);
            }
            if !joint.damping.is_zero() {
                let unit = if is_turning { "N*m*s" } else { "N*s/m" };
                let text = joint.damping.to_string();
                let damping =
                    self.parameter(&mut entries, &format!("{value}_damping"), unit, &text);
                let damper = format!("{value} {{ damping: {damping}, stretch: {value} }}");
                self.text.add("dampers", None, vec![damper]);
            }
            match self.call.friction {
                Some(Friction::Smooth(rate)) if !joint.friction.is_zero() => {
                    let unit = if is_turning { "N*m" } else { "N" };
                    let text = joint.friction.to_string();
                    let friction =
                        self.parameter(&mut entries, &format!("{value}_friction"), unit, &text);
                    let (smoothing, name, unit) = if is_turning {
                        (&mut smoothing, "smoothing", "rad/s")
                    } else {
                        (&mut smoothing_of_slides, "smoothing_of_slides", "m/s")
                    };
                    if smoothing.is_none() {
                        let mut entry = Vec::new();
                        let rate = Number::computed(rate).to_string();
                        *smoothing = Some(self.parameter(&mut entry, name, unit, &rate));
                        let comment = "Below this rate friction falls to zero instead of sticking.";
                        self.text.add("parameters", Some(comment.to_owned()), entry);
                    }
                    let rate = smoothing.clone().unwrap_or_default();
                    let formula = format!("{value}: {friction}*sqrt(der({value})^2 + {rate}^2)");
                    self.text.add("dissipations", None, vec![formula]);
                }
                Some(Friction::None) if !joint.friction.is_zero() => {
                    left_out.push(quoted(&joint.name));
                }
                _ => {}
            }
            if let Some([lower, upper]) = &joint.range {
                limited += 1;
                if self.call.limits != Limits::None {
                    self.range(
                        joint,
                        &value,
                        [lower, upper],
                        &mut entries,
                        &mut restitution,
                        faults,
                    );
                }
            }
            let comment = format!("Joint {}: the forces along it.", quoted(&joint.name));
            self.text.add("parameters", Some(comment), entries);
        }
        if !left_out.is_empty() {
            let count = counted(left_out.len(), "joint", "joints");
            self.warnings.push(format!(
                "friction is left out of {count}: {}",
                left_out.join(", ")
            ));
        }
        if limited > 0 && self.call.limits == Limits::None {
            let count = counted(limited, "joint", "joints");
            self.warnings.push(format!(
                "limits of {count} are written as comments only; with --limits assume a run reports when it leaves them, with --limits stop \
                 they stop it"
            ));
        }
    }

    /// Handles the limits of a joint.
    fn range(
        &mut self,
        joint: &Joint,
        value: &str,
        range: [&Number; 2],
        entries: &mut Vec<String>,
        restitution: &mut Option<String>,
        faults: &mut Faults,
    ) {
        if range[0].value >= range[1].value && joint.mimic.is_some() {
            let name = quoted(&joint.name);
            faults.add(
                joint.at,
                format!("the limits of joint {name} leave it no range"),
            );
        }
        let unit = unit_of(joint);
        let [lower, upper] = [("lower", range[0]), ("upper", range[1])].map(|(end, bound)| {
            let text = measured(joint, bound);
            self.parameter(entries, &format!("{value}_{end}"), unit, &text)
        });
        if self.call.limits == Limits::Assume {
            let facts = vec![format!("{value} >= {lower}"), format!("{value} <= {upper}")];
            return self.text.add("assume", None, facts);
        }
        if restitution.is_none() {
            let mut entry = Vec::new();
            *restitution = Some(self.parameter(&mut entry, "stop_restitution", "1", "0"));
            let comment =
                "The fraction of its rate with which a joint rebounds from the end of its range.";
            self.text.add("parameters", Some(comment.to_owned()), entry);
        }
        let restitution = restitution.clone().unwrap_or_default();
        let gaps = [
            ("lower", format!("{value} - {lower}")),
            ("upper", format!("{upper} - {value}")),
        ];
        for (end, gap) in gaps {
            // A gap is a length: for a rotation that of the arc with a radius of 1 m, which has no effect for rigid stops.
            let gap = match joint.kind {
                JointKind::Prismatic => gap,
                _ => format!("1*m*({gap})"),
            };
            let contact = format!("{value}_{end} {{ gap: {gap}, restitution: {restitution} }}");
            self.text.add("contacts", None, vec![contact]);
        }
    }

    /// Adds inputs, and the forces that depend on them.
    fn drives(&mut self) {
        for drive in &self.robot.drives {
            self.drive(drive);
        }
    }

    fn drive(&mut self, drive: &Drive) {
        let joint = &self.robot.joints[drive.joint];
        if self.is_dropped[drive.joint] {
            let name = quoted(&drive.name);
            return self
                .warnings
                .push(format!("drive {name} is left out with its joint"));
        }
        let value = self.value_of[drive.joint].clone();
        let is_turning = joint.kind != JointKind::Prismatic;
        let [force, travel, rate, stiffness, damping, mass] = if is_turning {
            ["N*m", "rad", "rad/s", "N*m", "N*m*s", "kg*m^2"]
        } else {
            ["N", "m", "m/s", "N/m", "N*s/m", "kg"]
        };
        let suffix = match (&drive.law, is_turning) {
            (Law::Force, true) => "torque",
            (Law::Force, false) => "force",
            (Law::Affine { .. }, _) => "control",
            (Law::Position { .. }, _) => "target",
            (Law::Rate { .. }, _) => "target_rate",
        };
        let name = if drive.name.is_empty() || drive.name == joint.name {
            format!("{}_{suffix}", joint.name)
        } else {
            drive.name.clone()
        };
        let input = self.values.take(&name, "input");
        let mut entries = Vec::new();
        let mut added = |writer: &mut Self, suffix: &str, unit: &str, number: &Number| {
            let name = format!("{input}_{suffix}");
            writer.parameter(&mut entries, &name, unit, &number.to_string())
        };
        let gear = if drive.gear.value == 1.0 {
            String::new()
        } else {
            format!("{}*", added(self, "gear", "1", &drive.gear))
        };
        let (unit, law) = match &drive.law {
            Law::Force => (force, input.clone()),
            Law::Position {
                stiffness: k,
                damping: b,
            } => {
                let k = added(self, "stiffness", stiffness, k);
                let mut law = format!("{k}*({input} - {gear}{value})");
                if !b.is_zero() {
                    let b = added(self, "damping", damping, b);
                    law.push_str(&format!(" - {b}*{gear}der({value})"));
                }
                if !gear.is_empty() && !b.is_zero() {
                    law = format!("({law})");
                }
                (travel, law)
            }
            Law::Rate { damping: b } => {
                let b = added(self, "damping", damping, b);
                (rate, format!("{b}*({input} - {gear}der({value}))"))
            }
            Law::Affine {
                gain,
                constant,
                of_length,
                of_rate,
            } => {
                let mut law = format!("{}*{input}", added(self, "gain", force, gain));
                let terms = [
                    (constant, "constant", force, String::new()),
                    (of_length, "of_length", stiffness, format!("*{gear}{value}")),
                    (of_rate, "of_rate", damping, format!("*{gear}der({value})")),
                ];
                for (number, suffix, unit, times) in terms {
                    if !number.is_zero() {
                        law.push_str(&format!(" + {}{times}", added(self, suffix, unit, number)));
                    }
                }
                ("1", format!("({law})"))
            }
        };
        let (coordinate, factor) = self.coordinate_of[drive.joint].clone();
        let on = self.value_of[coordinate].clone();
        let law = if factor.is_empty() || law.starts_with('(') {
            law
        } else {
            format!("({law})")
        };
        let force = format!("{input} {{ on: {on}, value: {factor}{gear}{law} }}");
        if !drive.inertia.is_zero() {
            let inertia = added(self, "inertia", mass, &drive.inertia);
            let rotor = format!("{input} {{ inertia: {inertia}, angle: {gear}{value} }}");
            self.text.add("rotors", None, vec![rotor]);
        }
        self.text.add("forces", None, vec![force]);
        let shown = if drive.name.is_empty() {
            String::new()
        } else {
            format!(" {}", quoted(&drive.name))
        };
        let comment = format!("Drive{shown} of joint {}.", quoted(&joint.name));
        self.text.add("parameters", Some(comment.clone()), entries);
        let usual = if drive.usual.is_zero() {
            String::new()
        } else {
            format!(" = {}", drive.usual)
        };
        let entry = format!("{input}: {unit}{usual}");
        self.text.add("inputs", Some(comment), vec![entry]);
    }

    /// Adds equations between coordinates.
    fn ties(&mut self) {
        let mut names = Names::default();
        for tie in &self.robot.ties {
            let (follower, leader, coefficients) = match &tie.kind {
                TieKind::Polynomial {
                    follower,
                    leader,
                    coefficients,
                } => (follower, leader, coefficients),
                TieKind::Closing {
                    anchors,
                    axes,
                    varies,
                } => {
                    self.closing(&tie.name, anchors, axes.as_ref(), varies, &mut names);
                    continue;
                }
            };
            let name = names.take(&tie.name, "constraint");
            let relative = |writer: &Self, joint: usize| match writer.reference_of[joint].as_str() {
                "" => writer.value_of[joint].clone(),
                reference => format!("({} - {reference})", writer.value_of[joint]),
            };
            let follower_unit = unit_of(&self.robot.joints[*follower]);
            let mut entries = Vec::new();
            let mut terms = Vec::new();
            for (power, coefficient) in coefficients.iter().enumerate() {
                if coefficient.is_zero() {
                    continue;
                }
                let led = leader.map(|leader| {
                    let unit = unit_of(&self.robot.joints[leader]);
                    (relative(self, leader), unit)
                });
                let (times, unit) = match (power, led) {
                    (0, _) | (_, None) => (String::new(), follower_unit.to_owned()),
                    (1, Some((led, of))) if of == follower_unit => {
                        if coefficient.value == 1.0 {
                            terms.push(led);
                            continue;
                        }
                        (format!("*{led}"), "1".to_owned())
                    }
                    (1, Some((led, of))) => (format!("*{led}"), format!("{follower_unit}/{of}")),
                    (_, Some((led, of))) => (
                        format!("*{led}^{power}"),
                        format!("{follower_unit}/{of}^{power}"),
                    ),
                };
                let name = format!("{name}_c{power}");
                let text = coefficient.to_string();
                let coefficient = self.parameter(&mut entries, &name, &unit, &text);
                terms.push(format!("{coefficient}{times}"));
            }
            let sum = if terms.is_empty() {
                "0".to_owned()
            } else {
                terms.join(" + ")
            };
            let left = relative(self, *follower);
            let comment = format!("Constraint {}.", quoted(&tie.name));
            self.text.add("parameters", Some(comment.clone()), entries);
            self.text.add(
                "constraints",
                Some(comment),
                vec![format!("{name}: {left} = {sum}")],
            );
        }
    }

    /// A closed loop: a point of a link coincides with one of another, and optionally their axes do.
    fn closing(
        &mut self,
        name: &str,
        anchors: &[Anchor; 2],
        axes: Option<&Matrix3<f64>>,
        varies: &[bool; 6],
        names: &mut Names,
    ) {
        let frame = |writer: &Self, anchor: &Anchor| {
            let links = writer.robot.links.iter();
            let place = links
                .map(|link| &link.name)
                .position(|it| *it == anchor.link);
            place.map(|place| writer.frame_of[place].clone())
        };
        let [first_frame, second_frame] = anchors.each_ref().map(|anchor| frame(self, anchor));
        let (Some(first_frame), Some(second_frame)) = (
            first_frame.filter(|frame| !frame.is_empty()),
            second_frame.filter(|frame| !frame.is_empty()),
        ) else {
            let name = quoted(name);
            let message = format!("constraint {name} is left out with its body");
            return self.warnings.push(message);
        };
        if !varies.contains(&true) {
            let message = format!(
                "constraint {} is left out: it holds in all positions of the joints",
                quoted(name)
            );
            return self.warnings.push(message);
        }
        let comment = format!("Constraint {}.", quoted(name));
        let (places, turns) = varies.split_at(3);
        let mut lines = self.meeting(name, [&first_frame, &second_frame], anchors, places, names);
        if let Some(axes) = axes.filter(|_| turns.contains(&true)) {
            let vector = |frame: &str, xyz: [f64; 3]| {
                let [x, y, z] = xyz.map(|x| {
                    if x.abs() <= 4.0 * f64::EPSILON {
                        "0".to_owned()
                    } else {
                        Number::computed(x).to_string()
                    }
                });
                match frame {
                    "ground" => format!("({x}, {y}, {z})"),
                    frame => format!("{frame}.vector({x}, {y}, {z})"),
                }
            };
            // One condition for each axis: that the two others stay orthogonal.
            for (about, axis) in AXES.iter().enumerate().filter(|(about, _)| turns[*about]) {
                let (next, last) = ((about + 1) % 3, (about + 2) % 3);
                let held = vector(&first_frame, axes.column(next).into_owned().into());
                let mut unit = [0.0; 3];
                unit[last] = 1.0;
                let second_axis = vector(&second_frame, unit);
                let name = names.take(&format!("{name}_about_{axis}"), "constraint");
                lines.push(format!("{name}: dot({held}, {second_axis}) = 0"));
            }
            // The right angles also hold in seven other orientations, by which the axes are interchanged or reversed in pairs. The sum
            // of the cosines between corresponding axes is 0 or −1 in these, and 3 in the orientation that is meant.
            let cosines = (0..3).map(|axis| {
                let mut unit = [0.0; 3];
                unit[axis] = 1.0;
                let held = vector(&first_frame, axes.column(axis).into_owned().into());
                format!("dot({held}, {})", vector(&second_frame, unit))
            });
            let fact = format!("{} > 1", cosines.collect::<Vec<_>>().join(" + "));
            let why = format!(
                "Constraint {}: no axis is reversed or interchanged with another.",
                quoted(name)
            );
            self.text.add("assume", Some(why), vec![fact]);
        }
        self.text.add("constraints", Some(comment), lines);
    }

    /// The conditions that two points coincide, along those axes of the ground along which they vary.
    fn meeting(
        &mut self,
        name: &str,
        frames: [&str; 2],
        anchors: &[Anchor; 2],
        varies: &[bool],
        names: &mut Names,
    ) -> Vec<String> {
        if !varies.contains(&true) {
            return Vec::new();
        }
        let mut entries = Vec::new();
        let [first, second] = [0, 1].map(|index| {
            let called = format!("{name}_anchor_{}", index + 1);
            let [x, y, z] = self.lengths(&mut entries, &called, &anchors[index].xyz);
            match frames[index] {
                "ground" => format!("({x}, {y}, {z})"),
                frame if [&x, &y, &z].iter().all(|x| *x == "0") => format!("{frame}.origin"),
                frame => format!("{frame}.point({x}, {y}, {z})"),
            }
        });
        let comment = format!("Constraint {}.", quoted(name));
        self.text.add("parameters", Some(comment), entries);
        let is_zero = |point: &str| point == "(0, 0, 0)";
        let apart = match (is_zero(&first), is_zero(&second)) {
            (true, _) => second.clone(),
            (_, true) => first.clone(),
            _ => format!("{first} - {second}"),
        };
        let along = ["(1, 0, 0)", "(0, 1, 0)", "(0, 0, 1)"];
        let axes = AXES.iter().zip(along).zip(varies);
        let mut lines = Vec::new();
        for ((axis, along), _) in axes.filter(|(_, varies)| **varies) {
            let name = names.take(&format!("{name}_{axis}"), "constraint");
            lines.push(format!("{name}: dot({apart}, {along}) = 0"));
        }
        lines
    }

    /// Gravity as a vector, or a comment that there is none.
    fn gravity(&mut self) -> String {
        let numbers = match &self.robot.gravity {
            None => [Number::zero(), Number::zero(), Number::computed(-9.81)],
            Some(numbers) => numbers.clone(),
        };
        if numbers.iter().all(Number::is_zero) {
            return "none".to_owned();
        }
        let against = match self.robot.gravity {
            None => "; the file has none",
            Some(_) => "",
        };
        let [x, y, z] = &numbers;
        let is_down = x.is_zero() && y.is_zero() && z.value < 0.0;
        let g = self.gravity.clone();
        let mut entries = Vec::new();
        let (comment, vector) = if is_down {
            entries.push(format!("{g}: m/s^2 = {}", z.negated()));
            (
                format!("The acceleration of gravity, against z{against}."),
                format!("(0, 0, -{g})"),
            )
        } else {
            let parts: [String; 3] = std::array::from_fn(|axis| {
                if numbers[axis].is_zero() {
                    "0".to_owned()
                } else {
                    let (name, text) = (format!("{g}_{}", AXES[axis]), numbers[axis].to_string());
                    self.parameter(&mut entries, &name, "m/s^2", &text)
                }
            });
            (
                "The acceleration of gravity.".to_owned(),
                format!("({})", parts.join(", ")),
            )
        };
        self.text.add("parameters", Some(comment), entries);
        vector
    }

    fn finish(mut self, file: &str) -> Machine {
        let gravity = self.gravity();
        let mut comment = vec![format!(
            "Robot {}, imported from the {} file {}. Angles are in radians, lengths in metres.",
            quoted(&self.robot.name),
            self.robot.format,
            quoted(file)
        )];
        if !self.robot.left_out.is_empty() {
            let list = self.robot.left_out.join(", ");
            comment.push(format!("Not carried over: {list}."));
            self.warnings.push(format!("not carried over: {list}"));
        }
        for name in &self.robot.unneeded {
            let message = format!("--ignore {name}: there is nothing with that name to leave out");
            self.warnings.push(message);
        }
        let name = names::machine(&self.robot.name);
        let text = self.text.to_text(&name, &comment, &gravity);
        Machine {
            counts: ["coordinates", "bodies", "parameters"].map(|section| self.text.count(section)),
            name,
            text,
            warnings: [self.warnings, self.robot.warnings.clone()].concat(),
        }
    }
}

/// A word with an initial capital, for the beginning of a sentence.
fn capital(word: &str) -> String {
    let mut letters = word.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}

/// The unit of a joint's coordinate.
fn unit_of(joint: &Joint) -> &'static str {
    match joint.kind {
        JointKind::Prismatic => "m",
        _ => "rad",
    }
}

/// A joint value in the notation of a spec.
fn measured(joint: &Joint, value: &Number) -> String {
    match joint.kind {
        JointKind::Prismatic => value.to_string(),
        _ => value.in_radians(),
    }
}

/// The text of a joint's comment: its range, and limits of velocity and effort.
fn joint_comment(joint: &Joint) -> String {
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
