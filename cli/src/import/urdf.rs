//! Reader of URDF: links, joints, and errors with their lines.
//!
//! Formats: <https://wiki.ros.org/urdf/XML>.

use roxmltree::{Attribute, Node};

use super::faults::Faults;
use super::names::quoted;
use super::number::{Angle, Number};
use super::robot::{Drive, Inertial, Joint, JointKind, Law, Link, Mimic, Robot};
use super::steps::Turns;
use super::tensor;
use super::xml;

/// The joint types by name.
const KINDS: [(&str, JointKind); 7] = [
    ("revolute", JointKind::Revolute),
    ("continuous", JointKind::Continuous),
    ("prismatic", JointKind::Prismatic),
    ("fixed", JointKind::Fixed),
    ("floating", JointKind::Floating),
    ("planar", JointKind::Planar),
    ("spherical", JointKind::Spherical),
];

/// The name of a joint type.
fn label(kind: JointKind) -> &'static str {
    let named = KINDS.iter().find(|(_, known)| *known == kind);
    named.map_or("", |(name, _)| name)
}

/// Roll, pitch and yaw as rotations: yaw about z, then pitch about y, then roll about x.
fn turns(rpy: &[Number; 3]) -> Turns {
    let angle = |axis: usize| (axis, Angle::of(&rpy[axis]));
    let is_some = |(_, angle): &(usize, Angle)| !angle.is_zero();
    [2, 1, 0].map(angle).into_iter().filter(is_some).collect()
}

/// Elements of a link or a joint that do not affect its motion.
const WITHOUT_PART: [&str; 6] = [
    "visual",
    "collision",
    "contact",
    "calibration",
    "material",
    "hardwareInterface",
];

/// Gazebo extensions that affect the motion.
const MOTION_OF_GAZEBO: [&str; 7] = [
    "springStiffness",
    "springReference",
    "spring_stiffness",
    "spring_reference",
    "dampingFactor",
    "velocity_decay",
    "joint",
];

/// Reads a robot.
pub fn read(text: &str, ignored: &[String], faults: &mut Faults) -> Option<Robot> {
    let document = xml::open(text, 0, faults)?;
    let mut reader = Reader {
        ignored,
        faults,
        robot: Robot {
            format: "URDF",
            part: "link",
            ..Robot::default()
        },
        motors: Vec::new(),
        counts: Vec::new(),
    };
    reader.robot(document.root_element());
    reader.place_motors();
    let Reader {
        mut robot, counts, ..
    } = reader;
    robot.leave_out(ignored, counts);
    Some(robot)
}

struct Reader<'r, 'f> {
    ignored: &'r [String],
    faults: &'f mut Faults,
    robot: Robot,
    /// Actuators with the names of their joints and their positions in the text.
    motors: Vec<(String, usize, Drive)>,
    /// Elements that are left out, with their counts.
    counts: Vec<(String, usize)>,
}

/// The name of a link or a joint in messages.
fn called(node: Node<'_, '_>) -> String {
    let kind = node.tag_name().name();
    match node.attribute("name") {
        Some(name) => format!("{kind} {}", quoted(name)),
        None => format!("a {kind} without a name"),
    }
}

/// The position of a value.
fn place(attribute: &Attribute<'_, '_>) -> usize {
    attribute.range_value().start
}

impl Reader<'_, '_> {
    fn robot(&mut self, root: Node<'_, '_>) {
        let name = root.tag_name().name();
        if name != "robot" {
            let message = match name {
                "mujoco" => "this is MJCF: give its file the ending `.xml`".to_owned(),
                "sdf" => "this is SDF, which is not supported".to_owned(),
                _ => format!("`{}` is not a robot", name.escape_debug()),
            };
            let help = "a URDF file begins with `<robot name=\"…\">`";
            self.faults
                .add(root.range().start, format!("{message}: {help}"));
            return;
        }
        self.robot.name = root.attribute("name").unwrap_or_default().to_owned();
        self.only(root, "the robot", &["name", "version"]);
        for node in root.children().filter(Node::is_element) {
            if self.is_foreign(node, root) {
                continue;
            }
            match node.tag_name().name() {
                "link" => self.link(node),
                "joint" => self.joint(node),
                "material" => {}
                "transmission" => self.transmission(node),
                "gazebo" => self.gazebo(node),
                // Sensors have no effect on the motion, and `mujoco` contains compiler settings.
                name @ ("sensor" | "mujoco" | "ros2_control") => self.leave_out(name),
                _ => self.unknown(node, "a robot"),
            }
        }
    }

    /// Whether an element belongs to another language; macros are refused, others are treated as unknown.
    fn is_foreign(&mut self, node: Node<'_, '_>, root: Node<'_, '_>) -> bool {
        let space = node.tag_name().namespace();
        if space.is_none() || space == root.tag_name().namespace() {
            return false;
        }
        if space.is_some_and(|space| space.contains("xacro")) {
            let message =
                "this is a xacro file: expand its macros first, `xacro robot.xacro > robot.urdf`";
            self.faults.add(node.range().start, message);
        } else {
            self.unknown(node, "a robot");
        }
        true
    }

    fn leave_out(&mut self, name: &str) {
        match self.counts.iter_mut().find(|(known, _)| known == name) {
            Some((_, count)) => *count += 1,
            None => self.counts.push((name.to_owned(), 1)),
        }
    }

    fn is_ignored(&self, name: &str) -> bool {
        self.ignored.iter().any(|ignored| ignored == name)
    }

    /// Refuses an element that may affect the motion, unless the call says to ignore it.
    fn unknown(&mut self, node: Node<'_, '_>, owner: &str) {
        let name = node.tag_name().name();
        if self.is_ignored(name) {
            return self.leave_out(name);
        }
        self.faults.add(
            node.range().start,
            format!("`{name}` of {owner} is not known, and may change the motion; --ignore {name} leaves it out"),
        );
    }

    /// A motor with a gear, for one joint and one actuator. Transmissions of several are left out, unless they
    /// contain rotor inertias.
    fn transmission(&mut self, node: Node<'_, '_>) {
        const ROTORS: [&str; 4] = [
            "motorInertia",
            "motor_inertia",
            "rotorInertia",
            "rotor_inertia",
        ];
        let parts = |name: &'static str| {
            let children = node.children();
            children.filter(move |part| part.tag_name().name() == name)
        };
        let is_one = ["joint", "actuator"].map(|name| parts(name).count() == 1) == [true; 2];
        let rotor = node.descendants().find(|inner| {
            ROTORS.contains(&inner.tag_name().name())
                && inner.text().and_then(|text| text.trim().parse().ok()) != Some(0.0)
        });
        match (rotor, is_one && !self.is_ignored("transmission")) {
            (_, true) => self.motor(node, parts("joint").next(), parts("actuator").next(), rotor),
            (Some(rotor), false) if !self.is_ignored("transmission") => self.faults.add(
                rotor.range().start,
                format!(
                    "{}: a rotor that turns with several joints is not supported; --ignore transmission leaves it out",
                    called(node)
                ),
            ),
            _ => self.leave_out("transmission"),
        }
    }

    fn motor(
        &mut self,
        node: Node<'_, '_>,
        joint: Option<Node<'_, '_>>,
        actuator: Option<Node<'_, '_>>,
        rotor: Option<Node<'_, '_>>,
    ) {
        let name = joint.and_then(|joint| joint.attribute("name"));
        let Some(name) = name else {
            let message = format!("{} does not specify which joint it moves", called(node));
            return self.faults.add(node.range().start, message);
        };
        let number = |reader: &mut Self, inner: Node<'_, '_>| {
            let text = inner.text().unwrap_or_default().trim();
            Number::read(text).unwrap_or_else(|wrong| {
                let message = format!("{} of {}: {wrong}", inner.tag_name().name(), called(node));
                reader.faults.add(inner.range().start, message);
                Number::zero()
            })
        };
        let is_gear = |inner: &Node<'_, '_>| inner.tag_name().name() == "mechanicalReduction";
        let gear = match node.descendants().find(is_gear) {
            Some(inner) => {
                let gear = number(self, inner);
                if gear.is_zero() {
                    let message = format!("the reduction of {} is 0", called(node));
                    self.faults.add(inner.range().start, message);
                }
                gear
            }
            None => Number::computed(1.0),
        };
        let inertia = rotor.map(|rotor| number(self, rotor)).unwrap_or_default();
        if inertia.value < 0.0 {
            let message = format!("the rotor of {} has a negative inertia", called(node));
            self.faults.add(node.range().start, message);
        }
        let actuator = actuator.and_then(|actuator| actuator.attribute("name"));
        self.motors.push((
            name.to_owned(),
            node.range().start,
            Drive {
                name: actuator.unwrap_or_default().to_owned(),
                joint: 0,
                gear,
                law: Law::Force,
                inertia,
                number: 0,
                usual: Number::zero(),
            },
        ));
    }

    /// Assigns motors to the joints that they name.
    fn place_motors(&mut self) {
        for (name, at, drive) in std::mem::take(&mut self.motors) {
            let mut joints = self.robot.joints.iter();
            match joints.position(|joint| joint.name == name) {
                Some(joint) if self.robot.joints[joint].kind.is_single() => {
                    self.robot.drives.push(Drive { joint, ..drive });
                }
                Some(joint) if self.robot.joints[joint].kind == JointKind::Fixed => {
                    self.leave_out("transmission");
                }
                Some(_) => {
                    let message = format!(
                        "a transmission moves joint {}, which does not have exactly one coordinate; --ignore transmission leaves it out",
                        quoted(&name)
                    );
                    self.faults.add(at, message);
                }
                None => {
                    let message = format!(
                        "a transmission moves joint {}, but there is no such joint",
                        quoted(&name)
                    );
                    self.faults.add(at, message);
                }
            }
        }
    }

    fn gazebo(&mut self, node: Node<'_, '_>) {
        let inner = node.descendants().skip(1);
        let moving = inner.filter(Node::is_element).find(|inner| {
            let text = inner.text().unwrap_or_default().trim();
            let usual = match inner.tag_name().name() {
                "gravity" => ["true", "1"],
                "turnGravityOff" | "static" => ["false", "0"],
                name => return MOTION_OF_GAZEBO.contains(&name),
            };
            !usual.contains(&text)
        });
        match moving {
            Some(moving) if !self.is_ignored("gazebo") => {
                let name = moving.tag_name().name();
                self.faults.add(
                    moving.range().start,
                    format!("`{name}` in `gazebo` may change the motion, and is not supported; --ignore gazebo leaves it out"),
                );
            }
            _ => self.leave_out("gazebo"),
        }
    }

    /// The required name of an element.
    fn name(&mut self, node: Node<'_, '_>) -> String {
        match node.attribute("name") {
            Some(name) => name.to_owned(),
            None => {
                let kind = node.tag_name().name();
                let message = format!("a {kind} without a name: write `<{kind} name=\"…\">`");
                self.faults.add(node.range().start, message);
                String::new()
            }
        }
    }

    /// The children of an element, each of the expected ones at most once; others are refused.
    fn parts<'n, const N: usize>(
        &mut self,
        node: Node<'n, 'n>,
        owner: &str,
        expected: [&str; N],
    ) -> [Option<Node<'n, 'n>>; N] {
        let mut found = [None; N];
        for part in node.children().filter(Node::is_element) {
            let name = part.tag_name().name();
            let is_foreign = part.tag_name().namespace() != node.tag_name().namespace();
            match expected.iter().position(|known| *known == name) {
                Some(index) if !is_foreign => match found[index] {
                    None => found[index] = Some(part),
                    Some(_) => {
                        let message = format!("{owner} has more than one `{name}`: keep one");
                        self.faults.add(part.range().start, message);
                    }
                },
                None if !is_foreign && WITHOUT_PART.contains(&name) => {}
                _ => self.unknown(part, owner),
            }
        }
        found
    }

    /// Refuses unknown attributes, because they could have any effect.
    fn only(&mut self, node: Node<'_, '_>, owner: &str, known: &[&str]) {
        let element = node.tag_name().name();
        for attribute in node.attributes() {
            let name = attribute.name();
            if attribute.namespace().is_some() || known.contains(&name) {
                continue;
            }
            if self.is_ignored(name) {
                self.leave_out(name);
                continue;
            }
            let message = format!(
                "`{name}` of `{element}` of {owner} is not known, and may change the motion; it has {}; --ignore {name} leaves \
                 it out",
                known
                    .iter()
                    .map(|name| format!("`{name}`"))
                    .collect::<Vec<_>>()
                    .join(", ")
            );
            self.faults.add(attribute.range().start, message);
        }
    }

    /// An optional number.
    fn number(&mut self, node: Node<'_, '_>, owner: &str, name: &str) -> Option<Number> {
        let attribute = node.attribute_node(name)?;
        match Number::read(attribute.value().trim()) {
            Ok(number) => Some(number),
            Err(wrong) => {
                self.faults
                    .add(place(&attribute), format!("`{name}` of {owner}: {wrong}"));
                Some(Number::zero())
            }
        }
    }

    /// A required number.
    fn needed(&mut self, node: Node<'_, '_>, owner: &str, name: &str) -> Number {
        self.number(node, owner, name).unwrap_or_else(|| {
            let element = node.tag_name().name();
            let message = format!("`{element}` of {owner} lacks `{name}`");
            self.faults.add(node.range().start, message);
            Number::zero()
        })
    }

    /// Three numbers, zero by default.
    fn triple(&mut self, node: Node<'_, '_>, owner: &str, name: &str) -> [Number; 3] {
        let zero = [(); 3].map(|()| Number::zero());
        let Some(attribute) = node.attribute_node(name) else {
            return zero;
        };
        let numbers: Result<Vec<Number>, String> = attribute
            .value()
            .split_whitespace()
            .map(Number::read)
            .collect();
        let numbers = numbers.and_then(|numbers| {
            let count = numbers.len();
            <[Number; 3]>::try_from(numbers)
                .map_err(|_| format!("three numbers are expected, but there are {count}"))
        });
        numbers.unwrap_or_else(|wrong| {
            self.faults
                .add(place(&attribute), format!("`{name}` of {owner}: {wrong}"));
            zero
        })
    }

    /// The position and angles of an `origin`.
    fn origin(&mut self, node: Option<Node<'_, '_>>, owner: &str) -> [[Number; 3]; 2] {
        let Some(node) = node else {
            return [(); 2].map(|()| [(); 3].map(|()| Number::zero()));
        };
        self.only(node, owner, &["xyz", "rpy"]);
        ["xyz", "rpy"].map(|name| self.triple(node, owner, name))
    }

    fn link(&mut self, node: Node<'_, '_>) {
        let name = self.name(node);
        let owner = called(node);
        self.only(node, &owner, &["name", "type"]);
        let [inertial] = self.parts(node, &owner, ["inertial"]);
        let inertial = inertial.and_then(|inertial| self.inertial(inertial, &owner));
        let at = node.range().start;
        self.robot.links.push(Link {
            name,
            inertial,
            at,
            ..Link::default()
        });
    }

    /// The inertia of a link, if it has mass.
    fn inertial(&mut self, node: Node<'_, '_>, owner: &str) -> Option<Inertial> {
        let [origin, mass, inertia] = self.parts(node, owner, ["origin", "mass", "inertia"]);
        let [xyz, rpy] = self.origin(origin, owner);
        for (part, name) in [(mass, "mass"), (inertia, "inertia")] {
            if part.is_none() {
                let message = format!("`inertial` of {owner} lacks `{name}`");
                self.faults.add(node.range().start, message);
            }
        }
        let (mass_node, inertia_node) = (mass?, inertia?);
        self.only(mass_node, owner, &["value"]);
        let mass = self.needed(mass_node, owner, "value");
        let entries = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];
        self.only(inertia_node, owner, &entries);
        let tensor = entries.map(|name| self.needed(inertia_node, owner, name));
        let has_tensor = tensor.iter().any(|entry| !entry.is_zero());
        if mass.value < 0.0 {
            let message = format!("the mass of {owner} is negative");
            self.faults.add(mass_node.range().start, message);
        } else if mass.is_zero() && has_tensor {
            let message = format!("{owner} has a tensor of inertia but no mass: give it a mass");
            self.faults.add(mass_node.range().start, message);
        }
        if let Some(flaw) = tensor::flaw(&tensor) {
            let message =
                format!("the tensor of inertia of {owner} is impossible for a body: {flaw}");
            self.faults.add(inertia_node.range().start, message);
        }
        let is_turned = !rpy.iter().all(Number::is_zero);
        (!mass.is_zero()).then_some(Inertial {
            mass,
            xyz,
            turns: turns(&rpy),
            tensor,
            source: if is_turned {
                "; the file gives it in axes rotated by `rpy`"
            } else {
                ""
            },
        })
    }

    /// The link that `parent` or `child` of a joint names.
    fn end(
        &mut self,
        joint: Node<'_, '_>,
        node: Option<Node<'_, '_>>,
        owner: &str,
        end: &str,
    ) -> String {
        let link = node.and_then(|node| node.attribute("link"));
        if let Some(node) = node {
            self.only(node, owner, &["link"]);
        }
        link.map(str::to_owned).unwrap_or_else(|| {
            let at = node.unwrap_or(joint).range().start;
            let message = format!("{owner} has no {end}: write `<{end} link=\"…\"/>`");
            self.faults.add(at, message);
            String::new()
        })
    }

    fn joint(&mut self, node: Node<'_, '_>) {
        let name = self.name(node);
        let owner = called(node);
        self.only(node, &owner, &["name", "type"]);
        let kind = self.kind(node, &owner);
        let expected = [
            "origin",
            "parent",
            "child",
            "axis",
            "limit",
            "dynamics",
            "mimic",
            "safety_controller",
        ];
        let [origin, parent, child, axis, limit, dynamics, mimic, safety] =
            self.parts(node, &owner, expected);
        let [xyz, rpy] = self.origin(origin, &owner);
        let parent = self.end(node, parent, &owner, "parent");
        let child = self.end(node, child, &owner, "child");
        let axis = self.axis(axis, kind, &owner);
        let (range, mut remarks) = self.limit(limit, kind, &owner);
        remarks.extend(self.soft(safety, &owner));
        let [damping, friction] = self.dynamics(dynamics, kind, &owner);
        let mimic = mimic.and_then(|mimic| self.mimic(mimic, kind, &owner));
        let at = node.range().start;
        self.robot.joints.push(Joint {
            name,
            kind,
            label: label(kind),
            shown: [parent.clone(), child.clone()],
            parent,
            child,
            xyz,
            turns: turns(&rpy),
            axis,
            damping,
            friction,
            range,
            remarks,
            mimic,
            at,
            ..Joint::default()
        });
    }

    fn kind(&mut self, node: Node<'_, '_>, owner: &str) -> JointKind {
        let attribute = node.attribute_node("type");
        let name = attribute.map(|attribute| attribute.value().trim());
        let known = KINDS.iter().find(|(known, _)| Some(*known) == name);
        known.map(|(_, kind)| *kind).unwrap_or_else(|| {
            let at = attribute.map_or(node.range().start, |attribute| place(&attribute));
            let list: Vec<&str> = KINDS.iter().map(|(name, _)| *name).collect();
            let message = match name {
                Some(name) => format!("the type {} of {owner} is not known", quoted(name)),
                None => format!("{owner} has no type"),
            };
            self.faults
                .add(at, format!("{message}: there are {}", list.join(", ")));
            JointKind::Fixed
        })
    }

    /// The axis as a unit vector; by default x, as in URDF.
    fn axis(&mut self, node: Option<Node<'_, '_>>, kind: JointKind, owner: &str) -> [f64; 3] {
        const X: [f64; 3] = [1.0, 0.0, 0.0];
        let Some(node) = node else {
            return X;
        };
        self.only(node, owner, &["xyz"]);
        if node.attribute("xyz").is_none() {
            return X;
        }
        let axis = self.triple(node, owner, "xyz").map(|number| number.value);
        let largest = axis.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        if largest == 0.0 {
            if kind.is_single() || kind == JointKind::Planar {
                let message =
                    format!("the axis of {owner} has no direction: it consists of three zeros");
                self.faults.add(node.range().start, message);
            }
            return X;
        }
        // Scaled so that no square overflows or underflows.
        let axis = axis.map(|x| x / largest);
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        axis.map(|x| x / length)
    }

    /// The range, and the limits of velocity and effort for a comment.
    fn limit(
        &mut self,
        node: Option<Node<'_, '_>>,
        kind: JointKind,
        owner: &str,
    ) -> (Option<[Number; 2]>, Vec<(&'static str, Number)>) {
        let Some(node) = node else {
            return (None, Vec::new());
        };
        self.only(
            node,
            owner,
            &[
                "lower",
                "upper",
                "effort",
                "velocity",
                "acceleration",
                "deceleration",
                "jerk",
            ],
        );
        let mut remarks = Vec::new();
        for name in ["velocity", "effort", "acceleration", "deceleration", "jerk"] {
            remarks.extend(self.number(node, owner, name).map(|number| (name, number)));
        }
        let bounds = ["lower", "upper"].map(|name| self.number(node, owner, name));
        let has_range = matches!(kind, JointKind::Revolute | JointKind::Prismatic);
        let range = match bounds {
            [None, None] => None,
            // If a file gives only one bound, URDF defines the other as 0.
            bounds => Some(bounds.map(|bound| bound.unwrap_or_else(Number::zero))),
        };
        (range.filter(|_| has_range), remarks)
    }

    /// The limits of a safety controller.
    fn soft(&mut self, node: Option<Node<'_, '_>>, owner: &str) -> Vec<(&'static str, Number)> {
        let Some(node) = node else {
            return Vec::new();
        };
        let known = [
            "soft_lower_limit",
            "soft_upper_limit",
            "k_position",
            "k_velocity",
        ];
        self.only(node, owner, &known);
        let mut numbers = Vec::new();
        for name in known {
            numbers.extend(self.number(node, owner, name).map(|number| (name, number)));
        }
        numbers
    }

    /// Damping and friction.
    fn dynamics(
        &mut self,
        node: Option<Node<'_, '_>>,
        kind: JointKind,
        owner: &str,
    ) -> [Number; 2] {
        let Some(node) = node else {
            return [(); 2].map(|()| Number::zero());
        };
        self.only(node, owner, &["damping", "friction"]);
        let coefficients = ["damping", "friction"].map(|name| {
            let number = self.number(node, owner, name).unwrap_or_else(Number::zero);
            if number.value < 0.0 {
                let message = format!("`{name}` of {owner} is negative");
                self.faults.add(node.range().start, message);
            }
            number
        });
        let has_any = coefficients.iter().any(|number| !number.is_zero());
        if has_any && !kind.is_single() && kind != JointKind::Fixed {
            let message = format!(
                "`dynamics` of {owner}: URDF does not define damping and friction of a {} joint: remove them",
                label(kind)
            );
            self.faults.add(node.range().start, message);
        }
        coefficients
    }

    fn mimic(&mut self, node: Node<'_, '_>, kind: JointKind, owner: &str) -> Option<Mimic> {
        self.only(node, owner, &["joint", "multiplier", "offset"]);
        let at = node.range().start;
        let Some(joint) = node.attribute("joint") else {
            let message =
                format!("`mimic` of {owner} does not specify which joint: write `joint=\"…\"`");
            self.faults.add(at, message);
            return None;
        };
        if !kind.is_single() {
            let message = format!("{owner} is {}, and cannot mimic another", label(kind));
            self.faults.add(at, message);
            return None;
        }
        let multiplier = self.number(node, owner, "multiplier");
        Some(Mimic {
            joint: joint.to_owned(),
            multiplier: multiplier.unwrap_or_else(|| Number::computed(1.0)),
            offset: self
                .number(node, owner, "offset")
                .unwrap_or_else(Number::zero),
            at,
        })
    }
}
