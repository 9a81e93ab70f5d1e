//! Converts a robot to a machine: joints become coordinates, links become frames and bodies.

mod along_joints;
mod coordinates;

use super::faults::Faults;
use super::names::{self, Names, quoted};
use super::number::{Angle, Number};
use super::robot::{Inertial, Joint, JointKind, Robot};
use super::steps::AXES;
use super::tensor;
use super::text::{self, Text};
use super::tree::{self, Tree};
use crate::call::{Base, Import};
use coordinates::{joint_comment, measured, unit_of};

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
