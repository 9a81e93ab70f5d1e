//! Reader of MJCF, the format of MuJoCo: nested bodies, their joints, and forces along these.
//!
//! Format: <https://mujoco.readthedocs.io/en/stable/XMLreference.html>.

mod attributes;
mod bodies;
mod drives;
mod loops;
mod mesh;
mod scene;
mod solid;

use std::collections::{HashMap, HashSet};
use std::path::Path;

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use super::faults::Faults;
use super::names::quoted;
use super::number::{Angle, Number};
use super::robot::{Drive, Inertial, Joint, JointKind, Law, Link, Robot, Start, Tie, TieKind};
use super::steps::{self, Turns, conjugating};
use super::tensor;
use attributes::{ATTRIBUTES, DRIVES, OF_DRIVES, ORIENTATIONS, SWITCHES, WITHOUT_PART};
use scene::{Attribute, Classes, Element};
use solid::{Shape, Solid};

/// The default density, in kg/m³.
const DENSITY: f64 = 1000.0;

/// The global settings of a file.
struct Compiler {
    is_in_degrees: bool,
    sequence: String,
    /// Whether inertia is computed from geometry: never, where it is not given, or wherever there is geometry.
    from_geometry: Option<bool>,
    groups: [f64; 2],
    total_mass: Option<f64>,
    finds_limits: bool,
    /// Whether free bodies are aligned with their axes of inertia.
    aligns: bool,
    /// The folder of meshes, relative to that of the model.
    meshes: String,
    strips_paths: bool,
}

/// The pose of a frame in another frame.
#[derive(Clone, Debug, Default)]
struct Pose {
    xyz: [Number; 3],
    turns: Turns,
}

impl Pose {
    fn centre(&self) -> Vector3<f64> {
        Vector3::from(self.xyz.each_ref().map(|number| number.value))
    }

    /// Composes this pose with one relative to it.
    fn then(&self, next: &Pose) -> Pose {
        let turned = steps::axes(&self.turns) * next.centre();
        let xyz = if self.turns.is_empty() {
            next.xyz.clone()
        } else {
            turned.map(Number::computed).into()
        };
        Pose {
            xyz: std::array::from_fn(|axis| added(&self.xyz[axis], &xyz[axis])),
            turns: [self.turns.clone(), next.turns.clone()].concat(),
        }
    }
}

/// A sum, which keeps the digits of the other term where one is zero.
fn added(a: &Number, b: &Number) -> Number {
    match (a.is_zero(), b.is_zero()) {
        (true, _) => b.clone(),
        (_, true) => a.clone(),
        _ => Number::computed(a.value + b.value),
    }
}

/// An element with its class and its name in messages.
#[derive(Clone)]
struct Item<'e> {
    element: &'e Element,
    class: usize,
    owner: String,
    /// The name of the elements of its class that give its defaults.
    tag: &'e str,
}

impl<'e> Item<'e> {
    /// An element in a class, by its own name.
    fn of(element: &'e Element, class: usize, owner: String) -> Item<'e> {
        Item {
            element,
            class,
            owner,
            tag: &element.name,
        }
    }
}

/// Reads a robot. `file` reads further files.
pub fn read(
    text: &str,
    folder: &Path,
    file: &dyn Fn(&Path) -> Result<Vec<u8>, String>,
    ignored: &[String],
    faults: &mut Faults,
) -> Option<Robot> {
    let root = scene::read(text, folder, file, faults)?;
    if root.name != "mujoco" {
        let message = match root.name.as_str() {
            "robot" => "this is URDF: give its file the ending `.urdf`".to_owned(),
            name => format!(
                "{} is not a model: an MJCF file begins with `<mujoco>`",
                quoted(name)
            ),
        };
        faults.add(root.at, message);
        return None;
    }
    let classes = Classes::of(&root, faults);
    let mut reader = Reader {
        ignored,
        faults,
        classes,
        compiler: Compiler {
            is_in_degrees: true,
            sequence: "xyz".to_owned(),
            from_geometry: None,
            groups: [0.0, 5.0],
            total_mass: None,
            finds_limits: true,
            aligns: false,
            meshes: String::new(),
            strips_paths: false,
        },
        folder,
        file,
        meshes: HashMap::new(),
        robot: Robot {
            format: "MJCF",
            part: "body",
            gravity: Some([Number::zero(), Number::zero(), Number::computed(-9.81)]),
            ..Robot::default()
        },
        joints: HashMap::new(),
        given: names(&root),
        counts: Vec::new(),
        actuators: 0,
        aligned: Vec::new(),
    };
    reader.model(&root);
    let Reader {
        mut robot, counts, ..
    } = reader;
    robot.leave_out(ignored, counts);
    Some(robot)
}

struct Reader<'r, 'f, 'e> {
    ignored: &'r [String],
    faults: &'f mut Faults,
    classes: Classes<'e>,
    compiler: Compiler,
    robot: Robot,
    /// The index of each named joint.
    joints: HashMap<String, usize>,
    /// Meshes by name.
    meshes: HashMap<String, Item<'e>>,
    /// The folder of the model, and the function that reads files.
    folder: &'r Path,
    file: &'r dyn Fn(&Path) -> Result<Vec<u8>, String>,
    /// Names in use, or that occur in the file.
    given: HashSet<String>,
    /// The kinds of elements that are left out, with their counts.
    counts: Vec<(String, usize)>,
    /// The number of actuators, including those that are left out.
    actuators: usize,
    /// Free joints whose body is aligned with its axes of inertia, and where they are in the file.
    aligned: Vec<(String, usize)>,
}

/// The names of bodies and joints in a file.
fn names(root: &Element) -> HashSet<String> {
    let mut names = HashSet::from(["world".to_owned()]);
    let mut waiting = vec![root];
    while let Some(element) = waiting.pop() {
        waiting.extend(&element.children);
        if matches!(element.name.as_str(), "body" | "joint" | "freejoint") {
            names.extend(element.own("name").map(|name| name.value.clone()));
        }
    }
    names
}

/// The name of an element in messages.
fn called(element: &Element) -> String {
    let kind = &element.name;
    match element.own("name") {
        Some(name) => format!("{kind} {}", quoted(&name.value)),
        None => format!("a {kind} without a name"),
    }
}

impl<'e> Reader<'_, '_, 'e> {
    fn model(&mut self, root: &'e Element) {
        let name = root.own("model").map(|name| name.value.clone());
        self.robot.name = name.unwrap_or_else(|| "MuJoCo Model".to_owned());
        let is = |name: &'static str| {
            let parts = root.children.iter();
            parts.filter(move |part| part.name == name)
        };
        is("compiler").for_each(|element| self.compiler(element));
        is("option").for_each(|element| self.option(element));
        self.check_classes();
        let assets = is("asset").flat_map(|assets| &assets.children);
        for mesh in assets.filter(|asset| asset.name == "mesh") {
            self.mesh(mesh);
        }
        self.robot.links.push(Link {
            name: "world".to_owned(),
            ..Link::default()
        });
        for part in &root.children {
            match part.name.as_str() {
                "compiler" | "option" | "equality" | "actuator" => {}
                "worldbody" | "body" => {
                    let world = Parent {
                        name: "world".to_owned(),
                        is_world: true,
                    };
                    self.parts(
                        part,
                        &world,
                        0,
                        &Pose::default(),
                        &mut BodyContents::default(),
                    );
                }
                "tendon" => part.children.iter().for_each(|tendon| self.tendon(tendon)),
                name if WITHOUT_PART.contains(&name) => {}
                _ => self.unknown(part, "a model"),
            }
        }
        for element in is("equality").flat_map(|part| &part.children) {
            self.equality(element);
        }
        for element in is("actuator").flat_map(|part| &part.children) {
            self.actuator(element);
        }
        let keys = is("keyframe").flat_map(|part| &part.children);
        let is_home = |key: &&Element| key.own("name").is_some_and(|name| name.value == "home");
        let mut homes: Vec<&Element> = keys.filter(is_home).collect();
        if self.ignored.iter().any(|ignored| ignored == "keyframe") && !homes.is_empty() {
            self.count("keyframe");
            homes.clear();
        }
        let is_closing = |tie: &Tie| matches!(tie.kind, TieKind::Closing { .. });
        if homes.iter().any(|key| key.own("qpos").is_some())
            || self.robot.ties.iter().any(is_closing)
        {
            self.refuse_alignment();
        }
        homes
            .into_iter()
            .for_each(|key| self.read_home_keyframe(key));
        self.settle_mass();
    }

    fn count(&mut self, name: &str) {
        match self.counts.iter_mut().find(|(known, _)| known == name) {
            Some((_, count)) => *count += 1,
            None => self.counts.push((name.to_owned(), 1)),
        }
    }

    /// Refuses an element that may affect the motion, unless the call says to ignore it.
    fn refuse(&mut self, at: usize, name: &str, message: &str) {
        if self.ignored.iter().any(|ignored| ignored == name) {
            return self.count(name);
        }
        let message = format!("{message}; --ignore {name} leaves it out");
        self.faults.add(at, message);
    }

    /// Refuses free joints that move the axes of inertia in place of those of the body: places on the body, and its poses, refer to
    /// the former.
    fn refuse_alignment(&mut self) {
        for (owner, at) in std::mem::take(&mut self.aligned) {
            let message = format!(
                "{owner} is aligned with the axes of inertia of its body, to which `qpos` of the keyframe `home` and the anchors of \
                 `connect` and `weld` refer then, which is not supported"
            );
            self.refuse(at, "align", &message);
        }
    }

    fn unknown(&mut self, element: &Element, owner: &str) {
        let name = &element.name;
        let message = format!("`{name}` of {owner} is not supported, and may change the motion");
        self.refuse(element.at, name, &message);
    }

    /// Refuses unknown attributes, because they could have any effect.
    fn only(&mut self, element: &Element, owner: &str, key: &str) {
        let known = ATTRIBUTES.iter().find(|(name, _)| *name == key);
        let known = known.map_or(&[][..], |(_, list)| list);
        let of_drives: &[&str] = if DRIVES.contains(&key) {
            &OF_DRIVES
        } else {
            &[]
        };
        for attribute in &element.attributes {
            let name = attribute.name.as_str();
            if known.contains(&name) || of_drives.contains(&name) {
                continue;
            }
            let element = &element.name;
            let message = format!(
                "`{name}` of `{element}` of {owner} is not supported, and may change the motion"
            );
            self.refuse(attribute.at, name, &message);
        }
    }

    fn check_classes(&mut self) {
        let elements: Vec<&'e Element> = self.classes.elements().collect();
        for element in elements {
            let key = match element.name.as_str() {
                "equality" => "equality.joint",
                name => name,
            };
            if ATTRIBUTES.iter().any(|(name, _)| *name == key) {
                self.only(element, "a class", key);
            }
        }
    }

    /// An element with the class that it names, or the default class at its place.
    fn item(&mut self, element: &'e Element, class: usize) -> Item<'e> {
        let owner = called(element);
        let class = self.class(element, "class", class);
        Item::of(element, class, owner)
    }

    /// An element to which its class gives the defaults of elements with another name.
    fn item_as(&mut self, element: &'e Element, tag: &'e str) -> Item<'e> {
        let item = self.item(element, 0);
        Item { tag, ..item }
    }

    /// The class that an attribute names.
    fn class(&mut self, element: &'e Element, name: &str, otherwise: usize) -> usize {
        let Some(name) = element.own(name) else {
            return otherwise;
        };
        self.classes.named(&name.value).unwrap_or_else(|| {
            let message = format!("there is no class {}", quoted(&name.value));
            self.faults.add(name.at, message);
            otherwise
        })
    }

    fn attribute_of(&self, item: &Item<'e>, name: &str) -> Option<&'e Attribute> {
        self.attributes_of(item, name).next()
    }

    /// An attribute at every place that sets it for an item, the one that applies first.
    fn attributes_of<'s>(
        &'s self,
        item: &Item<'e>,
        name: &'s str,
    ) -> impl Iterator<Item = &'e Attribute> + use<'s, 'e> {
        let tags = if DRIVES.contains(&item.tag) && OF_DRIVES.contains(&name) {
            DRIVES.to_vec()
        } else {
            vec![item.tag]
        };
        let places = self.classes.places(item.element, item.class, tags);
        places.filter_map(move |place| place.own(name))
    }

    fn word(&self, item: &Item<'e>, name: &str) -> Option<&'e str> {
        self.attribute_of(item, name)
            .map(|attribute| attribute.value.as_str())
    }

    /// The value of a Boolean attribute; `None` for `auto`.
    fn flag(&mut self, item: &Item<'e>, name: &str) -> Option<bool> {
        let attribute = self.attribute_of(item, name)?;
        match attribute.value.as_str() {
            "true" | "1" => Some(true),
            "false" | "0" => Some(false),
            "auto" => None,
            value => {
                let message = format!(
                    "`{name}` of {}: {} is not `true`, `false` or `auto`",
                    item.owner,
                    quoted(value)
                );
                self.faults.add(attribute.at, message);
                None
            }
        }
    }

    /// A list of any length. Where an element gives fewer numbers than its class, the others remain those of the class.
    fn list(&mut self, item: &Item<'e>, name: &str) -> Option<(Vec<Number>, usize)> {
        let attributes: Vec<&'e Attribute> = self.attributes_of(item, name).collect();
        let mut list: Vec<Number> = Vec::new();
        for attribute in &attributes {
            let numbers = self.read_list(item, attribute)?;
            list.extend(numbers.into_iter().skip(list.len()));
        }
        let first = attributes.first()?;
        Some((list, first.at))
    }

    /// The numbers of one attribute.
    fn read_list(&mut self, item: &Item<'e>, attribute: &Attribute) -> Option<Vec<Number>> {
        let numbers = attribute.value.split_whitespace().map(Number::read);
        let numbers = numbers.collect::<Result<Vec<Number>, String>>();
        numbers
            .map_err(|wrong| {
                let message = format!("`{}` of {}: {wrong}", attribute.name, item.owner);
                self.faults.add(attribute.at, message);
            })
            .ok()
    }

    fn numbers<const N: usize>(&mut self, item: &Item<'e>, name: &str) -> Option<[Number; N]> {
        let attribute = self.attribute_of(item, name)?;
        let (numbers, at) = (self.read_list(item, attribute)?, attribute.at);
        let count = numbers.len();
        <[Number; N]>::try_from(numbers)
            .map_err(|_| {
                let expected = if N == 1 {
                    "one number is".to_owned()
                } else {
                    format!("{N} numbers are")
                };
                let message = format!(
                    "`{name}` of {}: {expected} expected, but there are {count}",
                    item.owner
                );
                self.faults.add(at, message);
            })
            .ok()
    }

    fn number(&mut self, item: &Item<'e>, name: &str) -> Option<Number> {
        self.numbers::<1>(item, name).map(|[number]| number)
    }

    /// A nonnegative number, 0 by default. For a polynomial it is the first coefficient; the others must be zero.
    fn coefficient(&mut self, item: &Item<'e>, name: &str) -> Number {
        let Some((numbers, at)) = self.list(item, name) else {
            return Number::zero();
        };
        let mut numbers = numbers.into_iter();
        let first = numbers.next().unwrap_or_default();
        if numbers.any(|number| !number.is_zero()) {
            let message = format!(
                "`{name}` of {} is a polynomial, which is not supported",
                item.owner
            );
            self.refuse(at, name, &message);
        }
        if first.value < 0.0 {
            let message = format!("`{name}` of {} is negative", item.owner);
            self.faults.add(at, message);
        }
        first
    }

    /// An angle of the file, in radians.
    fn radians(&self, number: Number) -> Number {
        if self.compiler.is_in_degrees {
            Number::computed(number.value.to_radians())
        } else {
            number
        }
    }

    fn angle(&self, number: &Number) -> Angle {
        if self.compiler.is_in_degrees {
            Angle::of_degrees(number)
        } else {
            Angle::of(number)
        }
    }

    fn compiler(&mut self, element: &'e Element) {
        self.only(element, "the model", "compiler");
        let item = self.item(element, 0);
        if let Some(angle) = self.word(&item, "angle") {
            self.compiler.is_in_degrees = angle == "degree";
        }
        if let Some(sequence) = self.attribute_of(&item, "eulerseq") {
            let is_fine = sequence.value.len() == 3
                && sequence
                    .value
                    .bytes()
                    .all(|letter| b"xyzXYZ".contains(&letter));
            if is_fine {
                self.compiler.sequence.clone_from(&sequence.value)
            } else {
                self.faults.add(
                    sequence.at,
                    "`eulerseq` must consist of three of the letters xyzXYZ",
                )
            }
        }
        if element.own("inertiafromgeom").is_some() {
            self.compiler.from_geometry = self.flag(&item, "inertiafromgeom");
        }
        if let Some(groups) = self.numbers::<2>(&item, "inertiagrouprange") {
            self.compiler.groups = groups.map(|number| number.value);
        }
        for name in ["assetdir", "meshdir"] {
            if let Some(folder) = self.word(&item, name) {
                self.compiler.meshes = folder.to_owned();
            }
        }
        if let Some(strips) = self.flag(&item, "strippath") {
            self.compiler.strips_paths = strips;
        }
        if let Some(mass) = self.number(&item, "settotalmass") {
            self.compiler.total_mass = (mass.value > 0.0).then_some(mass.value);
        }
        if let Some(finds) = self.flag(&item, "autolimits") {
            self.compiler.finds_limits = finds;
        }
        if let Some(aligns) = self.flag(&item, "alignfree") {
            self.compiler.aligns = aligns;
        }
        for (name, usual) in [
            ("boundmass", "0"),
            ("boundinertia", "0"),
            ("balanceinertia", "false"),
            ("coordinate", "local"),
        ] {
            if let Some(attribute) = element.own(name)
                && attribute.value != usual
                && attribute.value.parse() != Ok(0.0)
            {
                let message =
                    format!("`{name}` of the compiler changes the model, and is not supported");
                self.refuse(attribute.at, name, &message);
            }
        }
    }

    fn option(&mut self, element: &'e Element) {
        self.only(element, "the model", "option");
        let item = self.item(element, 0);
        if let Some(gravity) = self.numbers::<3>(&item, "gravity") {
            self.robot.gravity = Some(gravity);
        }
        for name in ["density", "viscosity"] {
            if let Some(unsupported) = element.own(name)
                && unsupported.value.parse() != Ok(0.0)
            {
                let message =
                    format!("`{name}` of a fluid changes the motion, and is not supported");
                self.refuse(unsupported.at, name, &message);
            }
        }
        if let Some(groups) = element.own("actuatorgroupdisable")
            && !groups.value.is_empty()
        {
            let message = "`actuatorgroupdisable` is not supported";
            self.refuse(groups.at, "actuatorgroupdisable", message);
        }
        for flag in element.children.iter().filter(|part| part.name == "flag") {
            for attribute in &flag.attributes {
                let name = attribute.name.as_str();
                match (name, attribute.value.as_str()) {
                    (_, "enable") => {}
                    ("gravity", _) => {
                        self.robot.gravity = Some([(); 3].map(|()| Number::zero()));
                    }
                    _ if SWITCHES.contains(&name) => {
                        let message = format!("`{name}` is switched off, which is not supported");
                        self.refuse(attribute.at, name, &message);
                    }
                    _ => {}
                }
            }
        }
    }

    /// The position and orientation of an element.
    fn pose(&mut self, item: &Item<'e>) -> Pose {
        Pose {
            xyz: self.numbers::<3>(item, "pos").unwrap_or_default(),
            turns: self.turns(item),
        }
    }

    fn turns(&mut self, item: &Item<'e>) -> Turns {
        let Some(name) = self.orientation(item) else {
            return Turns::new();
        };
        let turns = match name {
            "axisangle" => self.numbers::<4>(item, name).map(|[x, y, z, angle]| {
                let axis = Vector3::new(x.value, y.value, z.value);
                (axis.amax() > 0.0).then(|| conjugating(&unit(&axis), self.angle(&angle)))
            }),
            "euler" => self
                .numbers::<3>(item, name)
                .map(|angles| Some(self.turns_in_sequence(&angles))),
            name => {
                let axes = self.axes(item, name);
                axes.map(|axes| axes.map(|axes| steps::turns(&axes)))
            }
        };
        match turns {
            None => Turns::new(),
            Some(Some(turns)) => turns,
            Some(None) => {
                let at = self
                    .attribute_of(item, name)
                    .map_or(item.element.at, |it| it.at);
                let message = format!("`{name}` of {} has no direction", item.owner);
                self.faults.add(at, message);
                Turns::new()
            }
        }
    }

    /// The attribute that gives the orientation of an element.
    fn orientation(&mut self, item: &Item<'e>) -> Option<&'static str> {
        let given: Vec<&str> = ORIENTATIONS
            .into_iter()
            .filter(|name| item.element.own(name).is_some())
            .collect();
        match given[..] {
            // The nearest class that gives any orientation, whichever attribute the classes above use.
            [] => {
                let tags = vec![item.tag];
                let mut places = self.classes.places(item.element, item.class, tags);
                places.find_map(|place| {
                    ORIENTATIONS
                        .into_iter()
                        .find(|name| place.own(name).is_some())
                })
            }
            [name] => Some(name),
            [_, other, ..] => {
                let at = item.element.own(other).map_or(item.element.at, |it| it.at);
                let message = format!("{} specifies its orientation twice", item.owner);
                self.faults.add(at, message);
                None
            }
        }
    }

    /// The turns about the axes of the compiler's sequence of Euler angles.
    fn turns_in_sequence(&self, angles: &[Number; 3]) -> Turns {
        let mut turns = Turns::new();
        for (letter, angle) in self.compiler.sequence.bytes().zip(angles) {
            let axis = usize::from(letter.to_ascii_lowercase() - b'x');
            let turn = (axis, self.angle(angle));
            if letter.is_ascii_lowercase() {
                turns.push(turn)
            } else {
                turns.insert(0, turn)
            }
        }
        turns.retain(|(_, angle)| !angle.is_zero());
        turns
    }

    /// The axes that a quaternion, two axes or the third one give; the inner value is `None` if these have no direction.
    fn axes(&mut self, item: &Item<'e>, name: &str) -> Option<Option<Matrix3<f64>>> {
        match name {
            "quat" => self.numbers::<4>(item, name).map(|numbers| {
                let [w, x, y, z] = numbers.map(|number| number.value);
                let quaternion = Quaternion::new(w, x, y, z);
                (quaternion.norm() > 0.0).then(|| matrix(&quaternion))
            }),
            "xyaxes" => self.numbers::<6>(item, name).map(|numbers| {
                let numbers = numbers.map(|number| number.value);
                let x = Vector3::new(numbers[0], numbers[1], numbers[2]);
                let y = Vector3::new(numbers[3], numbers[4], numbers[5]);
                let x = x.try_normalize(0.0)?;
                let y = (y - x * x.dot(&y)).try_normalize(1e-10)?;
                Some(Matrix3::from_columns(&[x, y, x.cross(&y)]))
            }),
            _ => self.numbers::<3>(item, name).map(|numbers| {
                let z = Vector3::from(numbers.map(|number| number.value)).try_normalize(0.0)?;
                Some(towards(&z))
            }),
        }
    }
}

/// The axes of a frame rotated by a quaternion of any length.
fn matrix(quaternion: &Quaternion<f64>) -> Matrix3<f64> {
    *UnitQuaternion::new_normalize(*quaternion)
        .to_rotation_matrix()
        .matrix()
}

/// Axes whose third one points along a unit vector, by the smallest rotation from z.
fn towards(z: &Vector3<f64>) -> Matrix3<f64> {
    let axis = Vector3::z().cross(z);
    let sine = axis.norm();
    match axis.try_normalize(1e-14) {
        Some(axis) => {
            let angle = sine.atan2(z.z);
            let k = axis.cross_matrix();
            Matrix3::identity() + k * angle.sin() + k * k * (1.0 - angle.cos())
        }
        None if z.z > 0.0 => Matrix3::identity(),
        None => Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0)),
    }
}

/// A unit vector, computed without overflow.
fn unit(axis: &Vector3<f64>) -> [f64; 3] {
    let axis = axis / axis.amax();
    (axis / axis.norm()).into()
}

/// The parent of a body.
struct Parent {
    name: String,
    is_world: bool,
}

/// The contents of a body.
#[derive(Default)]
struct BodyContents<'e> {
    /// The element `inertial`, and the pose in the body of the frame that contains it.
    inertial: Option<(&'e Element, Pose)>,
    solids: Vec<Solid>,
    /// Geometry with unknown mass, and the reason.
    unknown: Vec<(&'e Element, String)>,
}
