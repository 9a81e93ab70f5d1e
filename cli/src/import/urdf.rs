//! A file of URDF: links, joints, and what is wrong with them, each with its line.
//!
//! Formats: <https://wiki.ros.org/urdf/XML>.

use roxmltree::{Attribute, Document, Node, ParsingOptions};

use super::names::quoted;
use super::number::Number;
use super::tensor::{self, Tensor};

/// A robot as its file has it.
#[derive(Debug, Default)]
pub struct Robot {
    pub name: String,
    pub links: Vec<Link>,
    pub joints: Vec<Joint>,
    /// What was left out because the call says so, and what has no part in the motion but is no geometry.
    pub left_out: Vec<String>,
    /// What the call wants to be left out, and is not there.
    pub unneeded: Vec<String>,
}

/// A rigid body, or a frame without mass.
#[derive(Debug)]
pub struct Link {
    pub name: String,
    /// None where there is no mass.
    pub inertial: Option<Inertial>,
    /// Where it stands in the text.
    pub at: usize,
}

/// Mass, mass centre in the link's frame, and the tensor about it in axes turned by `rpy`.
#[derive(Debug)]
pub struct Inertial {
    pub mass: Number,
    pub xyz: [Number; 3],
    pub rpy: [Number; 3],
    pub tensor: Tensor,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
    Floating,
    Planar,
    Spherical,
}

/// The types by name.
const KINDS: [(&str, Kind); 7] = [
    ("revolute", Kind::Revolute),
    ("continuous", Kind::Continuous),
    ("prismatic", Kind::Prismatic),
    ("fixed", Kind::Fixed),
    ("floating", Kind::Floating),
    ("planar", Kind::Planar),
    ("spherical", Kind::Spherical),
];

impl Kind {
    pub fn name(self) -> &'static str {
        KINDS
            .iter()
            .find(|(_, kind)| *kind == self)
            .map_or("", |(name, _)| name)
    }

    /// Whether it has one coordinate, which limits, damping and others are about.
    pub fn is_single(self) -> bool {
        matches!(self, Kind::Revolute | Kind::Continuous | Kind::Prismatic)
    }
}

/// What joins a link to its parent.
#[derive(Debug)]
pub struct Joint {
    pub name: String,
    pub kind: Kind,
    pub parent: String,
    pub child: String,
    pub xyz: [Number; 3],
    pub rpy: [Number; 3],
    pub axis: [f64; 3],
    pub damping: Number,
    pub friction: Number,
    /// The least and the greatest value.
    pub range: Option<[Number; 2]>,
    /// Bounds of velocity and effort, soft limits: what a comment says.
    pub remarks: Vec<(&'static str, Number)>,
    pub mimic: Option<Mimic>,
    pub at: usize,
}

/// A joint that follows another: multiplier times its value and offset.
#[derive(Debug)]
pub struct Mimic {
    pub joint: String,
    pub multiplier: Number,
    pub offset: Number,
    pub at: usize,
}

/// What is wrong with a file.
pub struct Faults<'a> {
    file: &'a str,
    text: &'a str,
    found: Vec<(usize, String)>,
}

impl<'a> Faults<'a> {
    pub fn new(file: &'a str, text: &'a str) -> Faults<'a> {
        Faults {
            file,
            text,
            found: Vec::new(),
        }
    }

    /// Something is wrong at a place in the text.
    pub fn add(&mut self, at: usize, message: impl Into<String>) {
        self.found.push((at, message.into()));
    }

    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// All of it in the order of the file, a line each, as `file:line:column: message`.
    pub fn told(mut self) -> String {
        const MOST: usize = 20;
        self.found.sort();
        let mut lines: Vec<String> = Vec::new();
        for (at, message) in self.found.iter().take(MOST) {
            let before = self.text.get(..*at).unwrap_or_default();
            let line = before.matches('\n').count() + 1;
            let start = before.rfind('\n').map_or(0, |end| end + 1);
            let column = before[start..].chars().count() + 1;
            lines.push(format!("{}:{line}:{column}: {message}", self.file));
        }
        if self.found.len() > MOST {
            lines.push(format!("and {} more", self.found.len() - MOST));
        }
        lines.join("\n")
    }
}

/// Elements below a link or a joint that do not change how it moves.
const WITHOUT_PART: [&str; 6] = [
    "visual",
    "collision",
    "contact",
    "calibration",
    "material",
    "hardwareInterface",
];

/// What Gazebo adds to a model and changes its motion.
const MOTION_OF_GAZEBO: [&str; 7] = [
    "springStiffness",
    "springReference",
    "spring_stiffness",
    "spring_reference",
    "dampingFactor",
    "velocity_decay",
    "joint",
];

/// The reader of XML compares every attribute of an element with every other.
const MOST_ATTRIBUTES: usize = 1000;

/// Where an element begins that has more attributes than can be read in a moment.
fn overlong_element(text: &str) -> Option<usize> {
    let mut at = 0;
    for element in text.split('<') {
        let is_element = !element.starts_with(['!', '?']);
        let mut quoted = 0;
        let mut before = b' ';
        for byte in element.bytes().filter(|byte| !byte.is_ascii_whitespace()) {
            quoted += usize::from(before == b'=' && matches!(byte, b'"' | b'\''));
            before = byte;
        }
        if is_element && quoted > MOST_ATTRIBUTES {
            return Some(at.max(1) - 1);
        }
        at += element.len() + 1;
    }
    None
}

/// Reads a robot.
pub fn read(text: &str, ignored: &[String], faults: &mut Faults<'_>) -> Option<Robot> {
    if let Some(at) = overlong_element(text) {
        let message = format!("an element has more than {MOST_ATTRIBUTES} attributes");
        faults.add(at, message);
        return None;
    }
    let options = ParsingOptions {
        allow_dtd: false,
        ..ParsingOptions::default()
    };
    let document = match Document::parse_with_options(text, options) {
        Ok(document) => document,
        Err(error) => {
            let place = error.pos();
            let line = place.row as usize;
            let before = text.split_inclusive('\n').take(line.saturating_sub(1));
            let start: usize = before.map(str::len).sum();
            let rest = text[start..].char_indices();
            let column = rest
                .map(|(at, _)| at)
                .nth(place.col.saturating_sub(1) as usize);
            let at = start + column.unwrap_or(0);
            let message = error.to_string();
            let message = match message.rsplit_once(" at ") {
                Some((what, _)) => what,
                None => &message,
            };
            faults.add(at, format!("no XML: {message}"));
            return None;
        }
    };
    let mut reader = Reader {
        ignored,
        faults,
        robot: Robot::default(),
        counts: Vec::new(),
    };
    reader.robot(document.root_element());
    let Reader {
        mut robot, counts, ..
    } = reader;
    let is_unneeded = |name: &&String| counts.iter().all(|(what, _)| what != *name);
    robot.unneeded = ignored.iter().filter(is_unneeded).cloned().collect();
    for (what, count) in counts {
        robot.left_out.push(match count {
            1 => format!("1 element `{what}`"),
            _ => format!("{count} elements `{what}`"),
        });
    }
    Some(robot)
}

struct Reader<'r, 'f, 't> {
    ignored: &'r [String],
    faults: &'f mut Faults<'t>,
    robot: Robot,
    /// Elements that are left out, with how many there are.
    counts: Vec<(String, usize)>,
}

/// A link or a joint as messages name it.
fn called(node: Node<'_, '_>) -> String {
    let kind = node.tag_name().name();
    match node.attribute("name") {
        Some(name) => format!("{kind} {}", quoted(name)),
        None => format!("a {kind} without a name"),
    }
}

/// Where a value stands.
fn place(attribute: &Attribute<'_, '_>) -> usize {
    attribute.range_value().start
}

impl Reader<'_, '_, '_> {
    fn robot(&mut self, root: Node<'_, '_>) {
        let name = root.tag_name().name();
        if name != "robot" {
            let what = match name {
                "mujoco" => "this is MJCF, which is not read yet".to_owned(),
                "sdf" => "this is SDF, which is not read".to_owned(),
                _ => format!("`{}` is no robot", name.escape_debug()),
            };
            let help = "a file of URDF begins with `<robot name=\"…\">`";
            self.faults
                .add(root.range().start, format!("{what}: {help}"));
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
                // Sensors see, and `mujoco` has settings of its compiler.
                name @ ("sensor" | "mujoco" | "ros2_control") => self.leave_out(name),
                _ => self.unknown(node, "a robot"),
            }
        }
    }

    /// Whether an element is one of another language; macros are refused, others as what is not known.
    fn is_foreign(&mut self, node: Node<'_, '_>, root: Node<'_, '_>) -> bool {
        let space = node.tag_name().namespace();
        if space.is_none() || space == root.tag_name().namespace() {
            return false;
        }
        if space.is_some_and(|space| space.contains("xacro")) {
            let message = "this is a file of macros: write the robot out first, `xacro robot.xacro > robot.urdf`";
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

    /// What may change the motion, for all that is known, and is refused unless the call says to leave it out.
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

    fn transmission(&mut self, node: Node<'_, '_>) {
        const ROTORS: [&str; 4] = [
            "motorInertia",
            "motor_inertia",
            "rotorInertia",
            "rotor_inertia",
        ];
        let rotor = node.descendants().find(|inner| {
            ROTORS.contains(&inner.tag_name().name())
                && inner.text().and_then(|text| text.trim().parse().ok()) != Some(0.0)
        });
        match rotor {
            Some(rotor) if !self.is_ignored("transmission") => self.faults.add(
                rotor.range().start,
                format!(
                    "{}: inertia of a rotor behind a gear is not in the language yet; --ignore transmission leaves it out",
                    called(node)
                ),
            ),
            _ => self.leave_out("transmission"),
        }
    }

    fn gazebo(&mut self, node: Node<'_, '_>) {
        let inner = node.descendants().skip(1);
        let moving = inner.filter(Node::is_element).find(|inner| {
            let said = inner.text().unwrap_or_default().trim();
            let usual = match inner.tag_name().name() {
                "gravity" => ["true", "1"],
                "turnGravityOff" | "static" => ["false", "0"],
                name => return MOTION_OF_GAZEBO.contains(&name),
            };
            !usual.contains(&said)
        });
        match moving {
            Some(moving) if !self.is_ignored("gazebo") => {
                let name = moving.tag_name().name();
                self.faults.add(
                    moving.range().start,
                    format!("`{name}` in `gazebo` may change the motion, and is not read; --ignore gazebo leaves it out"),
                );
            }
            _ => self.leave_out("gazebo"),
        }
    }

    /// The name that an element has to have.
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

    /// The elements below one, each of the expected ones once at most; others are refused.
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

    /// Refuses attributes that are not known: they could say anything.
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

    /// A number that may be left out.
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

    /// A number that must be there.
    fn needed(&mut self, node: Node<'_, '_>, owner: &str, name: &str) -> Number {
        self.number(node, owner, name).unwrap_or_else(|| {
            let element = node.tag_name().name();
            let message = format!("`{element}` of {owner} lacks `{name}`");
            self.faults.add(node.range().start, message);
            Number::zero()
        })
    }

    /// Three numbers, zero where they are left out.
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
                .map_err(|_| format!("three numbers are expected, and there are {count}"))
        });
        numbers.unwrap_or_else(|wrong| {
            self.faults
                .add(place(&attribute), format!("`{name}` of {owner}: {wrong}"));
            zero
        })
    }

    /// Position and angles of an `origin`.
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
        self.robot.links.push(Link { name, inertial, at });
    }

    /// What a link weighs, if it weighs anything.
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
            let message = format!("{owner} has a tensor of inertia and no mass: give it a mass");
            self.faults.add(mass_node.range().start, message);
        }
        if let Some(flaw) = tensor::flaw(&tensor) {
            let message = format!("the tensor of inertia of {owner} is that of no body: {flaw}");
            self.faults.add(inertia_node.range().start, message);
        }
        (!mass.is_zero()).then_some(Inertial {
            mass,
            xyz,
            rpy,
            tensor,
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
            parent,
            child,
            xyz,
            rpy,
            axis,
            damping,
            friction,
            range,
            remarks,
            mimic,
            at,
        });
    }

    fn kind(&mut self, node: Node<'_, '_>, owner: &str) -> Kind {
        let attribute = node.attribute_node("type");
        let name = attribute.map(|attribute| attribute.value().trim());
        let known = KINDS.iter().find(|(known, _)| Some(*known) == name);
        known.map(|(_, kind)| *kind).unwrap_or_else(|| {
            let at = attribute.map_or(node.range().start, |attribute| place(&attribute));
            let list: Vec<&str> = KINDS.iter().map(|(name, _)| *name).collect();
            let what = match name {
                Some(name) => format!("the type {} of {owner} is not known", quoted(name)),
                None => format!("{owner} has no type"),
            };
            self.faults
                .add(at, format!("{what}: there are {}", list.join(", ")));
            Kind::Fixed
        })
    }

    /// The axis as a unit vector; x where it is left out, as URDF says.
    fn axis(&mut self, node: Option<Node<'_, '_>>, kind: Kind, owner: &str) -> [f64; 3] {
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
            if kind.is_single() || kind == Kind::Planar {
                let message = format!("the axis of {owner} has no direction: three zeros");
                self.faults.add(node.range().start, message);
            }
            return X;
        }
        // So that no square overflows or vanishes.
        let axis = axis.map(|x| x / largest);
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        axis.map(|x| x / length)
    }

    /// The range, and what a comment says of velocity and effort.
    fn limit(
        &mut self,
        node: Option<Node<'_, '_>>,
        kind: Kind,
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
        let has_range = matches!(kind, Kind::Revolute | Kind::Prismatic);
        let range = match bounds {
            [None, None] => None,
            // Where a file gives one bound only, URDF takes 0 as the other.
            bounds => Some(bounds.map(|bound| bound.unwrap_or_else(Number::zero))),
        };
        (range.filter(|_| has_range), remarks)
    }

    /// What a safety controller keeps to.
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
        let mut found = Vec::new();
        for name in known {
            found.extend(self.number(node, owner, name).map(|number| (name, number)));
        }
        found
    }

    /// Damping and friction.
    fn dynamics(&mut self, node: Option<Node<'_, '_>>, kind: Kind, owner: &str) -> [Number; 2] {
        let Some(node) = node else {
            return [(); 2].map(|()| Number::zero());
        };
        self.only(node, owner, &["damping", "friction"]);
        let found = ["damping", "friction"].map(|name| {
            let number = self.number(node, owner, name).unwrap_or_else(Number::zero);
            if number.value < 0.0 {
                let message = format!("`{name}` of {owner} is negative");
                self.faults.add(node.range().start, message);
            }
            number
        });
        let has_any = found.iter().any(|number| !number.is_zero());
        if has_any && !kind.is_single() && kind != Kind::Fixed {
            let message = format!(
                "`dynamics` of {owner}: URDF does not say what damping and friction of a {} joint are: take them out",
                kind.name()
            );
            self.faults.add(node.range().start, message);
        }
        found
    }

    fn mimic(&mut self, node: Node<'_, '_>, kind: Kind, owner: &str) -> Option<Mimic> {
        self.only(node, owner, &["joint", "multiplier", "offset"]);
        let at = node.range().start;
        let Some(joint) = node.attribute("joint") else {
            let message =
                format!("`mimic` of {owner} does not say which joint: write `joint=\"…\"`");
            self.faults.add(at, message);
            return None;
        };
        if !kind.is_single() {
            let message = format!("{owner} is {}, and cannot mimic another", kind.name());
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
