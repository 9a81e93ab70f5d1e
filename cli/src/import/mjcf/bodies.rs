//! Nested bodies with their joints and masses.

use super::*;

impl<'e> Reader<'_, '_, 'e> {
    /// The contents of a body, or of a frame in it, which has a pose.
    pub(super) fn parts(
        &mut self,
        owner: &'e Element,
        link: &Parent,
        class: usize,
        pose: &Pose,
        found: &mut BodyContents<'e>,
    ) {
        for part in &owner.children {
            match part.name.as_str() {
                "body" => self.body(part, link, class, pose),
                "frame" => {
                    let class = self.class(part, "childclass", class);
                    let item = Item::of(part, class, called(part));
                    self.only(part, &item.owner, "frame");
                    let inner = pose.then(&self.pose(&item));
                    self.parts(part, link, class, &inner, found);
                }
                "geom" => self.geom(part, link, class, pose, found),
                "joint" | "freejoint" if owner.name == "body" => {}
                "inertial" if !link.is_world => {
                    if found.inertial.replace((part, pose.clone())).is_some() {
                        let message =
                            format!("body {} has more than one `inertial`", quoted(&link.name));
                        self.faults.add(part.at, message);
                    }
                }
                "site" | "camera" | "light" => {}
                _ => self.unknown(part, &called(owner)),
            }
        }
    }

    /// A name that no link or joint has yet.
    fn name(&mut self, name: String) -> String {
        let mut unique = name.clone();
        let mut number = 2_usize;
        while !self.given.insert(unique.clone()) {
            unique = format!("{name}_{number}");
            number += 1;
        }
        unique
    }

    fn body(&mut self, element: &'e Element, parent: &Parent, class: usize, outer: &Pose) {
        let class = self.class(element, "childclass", class);
        let item = Item::of(element, class, called(element));
        self.only(element, &item.owner, "body");
        for (name, usual) in [("mocap", "false"), ("gravcomp", "0")] {
            if let Some(attribute) = element.own(name)
                && attribute.value != usual
                && attribute.value.parse() != Ok(0.0)
            {
                let message = format!(
                    "`{name}` of {} changes the motion, and is not supported",
                    item.owner
                );
                self.refuse(attribute.at, name, &message);
            }
        }
        let name = match element.own("name") {
            Some(name) => name.value.clone(),
            None => self.name(format!("{}_body", parent.name)),
        };
        let pose = outer.then(&self.pose(&item));
        let link = Parent {
            name: name.clone(),
            is_world: false,
        };
        let place = self.robot.links.len();
        self.robot.links.push(Link {
            name,
            at: element.at,
            ..Link::default()
        });
        let mut found = BodyContents::default();
        // Joints of a body come before those of the bodies in it, wherever they are in the file.
        let is_joint = |part: &&Element| matches!(part.name.as_str(), "joint" | "freejoint");
        let mut joints = Vec::new();
        for part in element.children.iter().filter(is_joint) {
            let item = self.item(part, class);
            self.only(part, &item.owner, &part.name);
            joints.push(item);
        }
        // A body that carries others is never aligned.
        if let [joint] = joints.as_slice()
            && (joint.element.name == "freejoint" || self.word(joint, "type") == Some("free"))
            && self.flag(joint, "align").unwrap_or(self.compiler.aligns)
            && !has_bodies(element)
        {
            self.aligned.push((joint.owner.clone(), joint.element.at));
        }
        self.chain(&link, parent, pose, &joints, element.at);
        self.parts(element, &link, class, &Pose::default(), &mut found);
        let inertial = self.weight(&link, &found);
        self.robot.links[place].inertial = inertial;
    }

    /// The chain of joints from a body to its parent: each joint has its own position, and the body's frame
    /// follows the last.
    fn chain(
        &mut self,
        link: &Parent,
        parent: &Parent,
        pose: Pose,
        joints: &[Item<'e>],
        at: usize,
    ) {
        let shown = [parent.name.clone(), link.name.clone()];
        let mut above = parent.name.clone();
        let Pose { xyz, mut turns } = pose;
        let mut shift = xyz;
        // The position of the previous joint, in the body's frame.
        let mut last = Vector3::zeros();
        let mut held = Vec::new();
        for (number, item) in joints.iter().enumerate() {
            let kind = self.kind(item);
            let mut joint = self.joint(item, kind, link);
            if kind == JointKind::Floating {
                if !parent.is_world || joints.len() > 1 {
                    self.refuse_free(item, link);
                }
                joint.start = Some(Start {
                    xyz: std::mem::take(&mut shift),
                    axes: steps::axes(&turns),
                });
                turns.clear();
            } else if kind != JointKind::Prismatic {
                let (step, position) = self.step_to(item, last);
                // This step follows the rotation of the body's frame.
                let before = Pose {
                    xyz: shift,
                    turns: turns.clone(),
                };
                shift = before.then(&step).xyz;
                last = position;
            }
            joint.parent = above;
            joint.xyz = std::mem::take(&mut shift);
            joint.turns = std::mem::take(&mut turns);
            joint.shown = shown.clone();
            let is_last = number + 1 == joints.len() && last == Vector3::zeros();
            above = if is_last {
                link.name.clone()
            } else {
                // Names in a file contain no line break, so this name is unique.
                let between = format!("{}\n{number}", link.name);
                self.robot.links.push(Link {
                    name: between.clone(),
                    is_between: true,
                    at,
                    ..Link::default()
                });
                between
            };
            joint.child.clone_from(&above);
            held.push(joint);
        }
        if above != link.name {
            let xyz = if joints.is_empty() {
                shift
            } else {
                (-last).map(Number::computed).into()
            };
            held.push(Joint {
                shown,
                at,
                ..to_frame(above, link, Pose { xyz, turns })
            });
        }
        for joint in held {
            let index = self.robot.joints.len();
            self.joints.insert(joint.name.clone(), index);
            self.robot.joints.push(joint);
        }
    }

    /// Refuses a free joint that is not the only one of a body of the world.
    fn refuse_free(&mut self, item: &Item<'e>, link: &Parent) {
        let message = format!(
            "{} lets body {} move freely: it must be the only joint of a body of the world",
            item.owner,
            quoted(&link.name)
        );
        self.faults.add(item.element.at, message);
    }

    /// The step from the previous joint of a body, at `last`, to another one, and its position.
    fn step_to(&mut self, item: &Item<'e>, last: Vector3<f64>) -> (Pose, Vector3<f64>) {
        let place = self.numbers::<3>(item, "pos").unwrap_or_default();
        let position = Vector3::from(place.each_ref().map(|number| number.value));
        // Where it begins at the origin, the number keeps its digits.
        let xyz = if last == Vector3::zeros() {
            place
        } else {
            (position - last).map(Number::computed).into()
        };
        let turns = Turns::new();
        (Pose { xyz, turns }, position)
    }

    fn kind(&mut self, item: &Item<'e>) -> JointKind {
        if item.element.name == "freejoint" {
            return JointKind::Floating;
        }
        match self.word(item, "type").unwrap_or("hinge") {
            "hinge" => JointKind::Revolute,
            "slide" => JointKind::Prismatic,
            "ball" => JointKind::Spherical,
            "free" => JointKind::Floating,
            other => {
                let message = format!(
                    "the type {} of {} is not known: there are hinge, slide, ball, free",
                    quoted(other),
                    item.owner
                );
                self.faults.add(item.element.at, message);
                JointKind::Revolute
            }
        }
    }

    fn joint(&mut self, item: &Item<'e>, kind: JointKind, link: &Parent) -> Joint {
        let element = item.element;
        let name = match element.own("name") {
            Some(name) => name.value.clone(),
            None => self.name(format!("{}_joint", link.name)),
        };
        let label = match kind {
            JointKind::Prismatic => "slide",
            JointKind::Spherical => "ball",
            JointKind::Floating => "free",
            _ => "hinge",
        };
        let mut joint = Joint {
            name,
            kind,
            label,
            axis: [0.0, 0.0, 1.0],
            at: element.at,
            ..Joint::default()
        };
        if element.name == "freejoint" {
            return joint;
        }
        joint.damping = self.coefficient(item, "damping");
        joint.friction = self.coefficient(item, "frictionloss");
        joint.stiffness = self.coefficient(item, "stiffness");
        joint.armature = self.coefficient(item, "armature");
        if let Some((numbers, at)) = self.list(item, "springdamper")
            && numbers.iter().any(|number| !number.is_zero())
        {
            let message = format!(
                "`springdamper` of {} specifies a spring by its period, which is not supported: write `stiffness` and `damping`",
                item.owner
            );
            self.refuse(at, "springdamper", &message);
        }
        if kind.is_single() {
            self.along_its_axis(item, &mut joint);
        } else {
            self.refuse_along(item, &mut joint);
            if self.is_limited(item, "limited", "range") {
                self.count("`range` of ball joint");
            }
        }
        joint
    }

    /// Refuses what acts along a joint that has several coordinates.
    fn refuse_along(&mut self, item: &Item<'e>, joint: &mut Joint) {
        let terms = [
            ("damping", &mut joint.damping),
            ("frictionloss", &mut joint.friction),
            ("stiffness", &mut joint.stiffness),
            ("armature", &mut joint.armature),
        ];
        for (name, number) in terms {
            if std::mem::take(number).is_zero() {
                continue;
            }
            let at = self
                .attribute_of(item, name)
                .map_or(item.element.at, |attribute| attribute.at);
            let message = format!(
                "`{name}` of {} belongs to a {} joint, which is not supported",
                item.owner, joint.label
            );
            self.refuse(at, name, &message);
        }
    }

    /// The axis of a joint with one coordinate, and what is given along it.
    fn along_its_axis(&mut self, item: &Item<'e>, joint: &mut Joint) {
        let is_angle = joint.kind != JointKind::Prismatic;
        let value = |reader: &mut Self, name: &str| {
            let number = reader.number(item, name).unwrap_or_default();
            if is_angle {
                reader.radians(number)
            } else {
                number
            }
        };
        joint.reference = value(self, "ref");
        joint.free_at = value(self, "springref");
        if let Some(axis) = self.numbers::<3>(item, "axis") {
            let axis = Vector3::from(axis.map(|number| number.value));
            if axis.amax() > 0.0 {
                joint.axis = unit(&axis)
            } else {
                let message = format!(
                    "the axis of {} has no direction: it consists of three zeros",
                    item.owner
                );
                self.faults.add(item.element.at, message);
            }
        }
        if self.is_limited(item, "limited", "range")
            && let Some(range) = self.numbers::<2>(item, "range")
        {
            joint.range = Some(if is_angle {
                range.map(|bound| self.radians(bound))
            } else {
                range
            });
        }
        if self.is_limited(item, "actuatorfrclimited", "actuatorfrcrange") {
            self.count("`actuatorfrcrange` of joint");
        }
    }

    /// Whether a range is enforced.
    pub(super) fn is_limited(&mut self, item: &Item<'e>, flag: &str, range: &str) -> bool {
        let has_range = self.attribute_of(item, range).is_some();
        let otherwise = has_range && self.compiler.finds_limits;
        self.flag(item, flag).unwrap_or(otherwise) && has_range
    }

    fn geom(
        &mut self,
        element: &'e Element,
        link: &Parent,
        class: usize,
        pose: &Pose,
        found: &mut BodyContents<'e>,
    ) {
        let item = self.item(element, class);
        self.only(element, &item.owner, "geom");
        let kind = self.word(&item, "type").unwrap_or("sphere");
        let number = |reader: &mut Self, name: &str, usual: f64| {
            reader
                .number(&item, name)
                .map_or(usual, |number| number.value)
        };
        let collides = ["contype", "conaffinity"].map(|name| number(self, name, 1.0) != 0.0);
        if collides.contains(&true) && !link.is_world {
            self.count("contacts of geom");
        }
        let group = number(self, "group", 0.0);
        let [least, most] = self.compiler.groups;
        if link.is_world || group < least || group > most {
            return;
        }
        let mass = self.number(&item, "mass").map(|mass| mass.value);
        let density = number(self, "density", DENSITY);
        if mass.unwrap_or(density) < 0.0 {
            let message = format!("the mass of {} is negative", item.owner);
            self.faults.add(element.at, message);
        }
        if mass.unwrap_or(density) == 0.0 {
            return;
        }
        if self.flag(&item, "shellinertia") == Some(true) {
            let message = format!("{} is a shell, whose inertia is not supported", item.owner);
            self.refuse(element.at, "shellinertia", &message);
        }
        if kind == "mesh" {
            match self.weight_of_mesh(&item) {
                Ok(volume) => {
                    let pose = pose.then(&self.pose(&item));
                    let axes = steps::axes(&pose.turns);
                    let mass = mass.unwrap_or(density * volume.volume);
                    found.solids.push(Solid {
                        mass,
                        centre: pose.centre() + axes * volume.centre,
                        tensor: axes * volume.tensor * axes.transpose() * (mass / volume.volume),
                    });
                }
                Err(why) => found.unknown.push((element, why)),
            }
            return;
        }
        let Some(shape) = self.shape(&item, kind) else {
            if !matches!(kind, "plane" | "hfield") {
                let why = format!("a {kind} of this kind is not supported");
                found.unknown.push((element, why));
            }
            return;
        };
        let frame = match self.between(&item) {
            Some([from, to]) => {
                let z = (from - to).try_normalize(0.0).unwrap_or_else(Vector3::z);
                let centre = pose.centre() + steps::axes(&pose.turns) * ((from + to) / 2.0);
                (centre, steps::axes(&pose.turns) * towards(&z))
            }
            None => {
                let pose = pose.then(&self.pose(&item));
                (pose.centre(), steps::axes(&pose.turns))
            }
        };
        let mass = mass.unwrap_or(density * shape.volume());
        found.solids.push(Solid::of(shape, mass, frame.0, &frame.1));
    }

    /// Registers a mesh, to which geometry may refer.
    pub(super) fn mesh(&mut self, element: &'e Element) {
        let item = self.item(element, 0);
        let file = self.word(&item, "file").unwrap_or_default();
        let stem = Path::new(file).file_stem().unwrap_or_default();
        let name = match element.own("name") {
            Some(name) => name.value.clone(),
            None => stem.to_string_lossy().into_owned(),
        };
        self.meshes.insert(name, item);
    }

    /// The volume of a geom's mesh in the geom's frame, or why it is unknown.
    fn weight_of_mesh(&mut self, geom: &Item<'e>) -> Result<mesh::Volume, String> {
        let name = self.word(geom, "mesh").unwrap_or_default();
        let item = self.meshes.get(name).cloned();
        let item = item.ok_or_else(|| format!("there is no mesh {}", quoted(name)))?;
        self.only(item.element, &item.owner, "mesh");
        let inside = match self.word(&item, "inertia").unwrap_or("legacy") {
            "legacy" => mesh::Inside::Absolute,
            "exact" => mesh::Inside::Signed,
            other => {
                return Err(format!(
                    "`inertia` {} of its mesh is not supported",
                    quoted(other)
                ));
            }
        };
        let mut mesh = match self.word(&item, "file") {
            Some(file) => {
                let path = Path::new(file);
                let path = match (self.compiler.strips_paths, path.file_name()) {
                    (true, Some(name)) => Path::new(name),
                    _ => path,
                };
                let path = self.folder.join(&self.compiler.meshes).join(path);
                mesh::Mesh::read(file, &(self.file)(&path)?)?
            }
            None => {
                let numbers = |reader: &mut Self, name: &str| {
                    let list = reader.list(&item, name).map(|(numbers, _)| numbers);
                    let list = list.unwrap_or_default();
                    list.iter().map(|number| number.value).collect::<Vec<f64>>()
                };
                let (points, faces) = (numbers(self, "vertex"), numbers(self, "face"));
                let text = |letter: &str, list: &[f64], first: f64| {
                    let line = |three: &[f64]| {
                        let words = three.iter().map(|x| format!(" {}", x + first));
                        format!("{letter}{}\n", words.collect::<String>())
                    };
                    list.chunks(3).map(line).collect::<String>()
                };
                if faces.is_empty() {
                    return Err("its mesh has points without faces".to_owned());
                }
                let text = text("v", &points, 0.0) + &text("f", &faces, 1.0);
                mesh::Mesh::read("numbers.obj", text.as_bytes())?
            }
        };
        let vector = |reader: &mut Self, name: &str, usual: f64| {
            let numbers = reader.numbers::<3>(&item, name);
            numbers.map_or(Vector3::repeat(usual), |three| {
                Vector3::from(three.map(|number| number.value))
            })
        };
        let (origin, scale) = (vector(self, "refpos", 0.0), vector(self, "scale", 1.0));
        let axes = match self.numbers::<4>(&item, "refquat") {
            Some(numbers) => {
                let [w, x, y, z] = numbers.map(|number| number.value);
                matrix(&Quaternion::new(w, x, y, z))
            }
            None => Matrix3::identity(),
        };
        for point in &mut mesh.points {
            *point = (axes.transpose() * (*point - origin)).component_mul(&scale);
        }
        if scale.product() < 0.0 {
            mesh.faces.iter_mut().for_each(|face| face.swap(1, 2));
        }
        mesh.inside(inside)
            .ok_or_else(|| "its mesh encloses no volume".to_owned())
    }

    /// The ends of a shape that is given by its ends.
    fn between(&mut self, item: &Item<'e>) -> Option<[Vector3<f64>; 2]> {
        let ends = self.numbers::<6>(item, "fromto")?;
        let ends = ends.map(|number| number.value);
        Some([[0, 1, 2], [3, 4, 5]].map(|places| Vector3::from(places.map(|place| ends[place]))))
    }

    /// A shape with known mass, unless it is invalid.
    fn shape(&mut self, item: &Item<'e>, kind: &str) -> Option<Shape> {
        if !matches!(
            kind,
            "sphere" | "capsule" | "cylinder" | "ellipsoid" | "box"
        ) {
            return None;
        }
        if self.attribute_of(item, "mesh").is_some() {
            return None;
        }
        let mut size: Vec<f64> = match self.list(item, "size") {
            Some((numbers, _)) => numbers.iter().map(|number| number.value).collect(),
            None => Vec::new(),
        };
        let ends = match kind {
            "sphere" => None,
            _ => self.between(item),
        };
        if let (Some([from, to]), Some(first)) = (ends, size.first().copied()) {
            let half = (from - to).norm() / 2.0;
            size = match kind {
                "capsule" | "cylinder" => vec![first, half],
                _ => vec![first, first, half],
            };
        }
        let needed = match kind {
            "sphere" => 1,
            "capsule" | "cylinder" => 2,
            _ => 3,
        };
        if size.len() < needed || size[..needed].iter().any(|size| *size <= 0.0) {
            let message = format!(
                "`size` of {}: {needed} positive numbers are expected for a {kind}",
                item.owner
            );
            self.faults.add(item.element.at, message);
            return None;
        }
        Some(match kind {
            "sphere" => Shape::Sphere { radius: size[0] },
            "capsule" => Shape::Capsule {
                radius: size[0],
                half: size[1],
            },
            "cylinder" => Shape::Cylinder {
                radius: size[0],
                half: size[1],
            },
            "ellipsoid" => Shape::Ellipsoid {
                radii: [size[0], size[1], size[2]],
            },
            _ => Shape::Box {
                halves: [size[0], size[1], size[2]],
            },
        })
    }

    /// The inertia of a body: as given, or computed from geometry.
    fn weight(&mut self, link: &Parent, found: &BodyContents<'e>) -> Option<Inertial> {
        let has_geometry = !found.solids.is_empty() || !found.unknown.is_empty();
        let from_geometry = match self.compiler.from_geometry {
            Some(true) => has_geometry || found.inertial.is_none(),
            Some(false) => false,
            None => found.inertial.is_none(),
        };
        if let (Some((inertial, pose)), false) = (&found.inertial, from_geometry) {
            return self.given_inertia(inertial, pose, link);
        }
        if !from_geometry {
            return None;
        }
        for (geom, why) in &found.unknown {
            let message = format!(
                "the mass of {} of body {} is not known, as {why}: give the body an `inertial`, or the geom `mass=\"0\"`",
                called(geom),
                quoted(&link.name)
            );
            self.faults.add(geom.at, message);
        }
        if found.solids.is_empty() {
            return None;
        }
        let Solid {
            mass,
            centre,
            tensor,
        } = Solid::combine(&found.solids);
        let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        Some(Inertial {
            mass: Number::computed(mass),
            xyz: centre.map(Number::computed).into(),
            turns: Turns::new(),
            tensor: entries.map(|place| Number::computed(tensor[place])),
            source: "; from its geoms",
        })
    }

    /// The inertia given by an element `inertial`, in a frame with this pose in the body.
    fn given_inertia(
        &mut self,
        element: &'e Element,
        frame: &Pose,
        link: &Parent,
    ) -> Option<Inertial> {
        let item = Item::of(element, 0, format!("body {}", quoted(&link.name)));
        self.only(element, &item.owner, "inertial");
        let Pose { xyz, turns } = frame.then(&self.pose(&item));
        let Some(mass) = self.number(&item, "mass") else {
            if element.own("mass").is_none() {
                let message = format!("`inertial` of {} lacks `mass`", item.owner);
                self.faults.add(element.at, message);
            }
            return None;
        };
        let full = self.numbers::<6>(&item, "fullinertia");
        let diagonal = self.numbers::<3>(&item, "diaginertia");
        let tensor = match (full, diagonal) {
            (Some(full), _) => full,
            (None, Some([x, y, z])) => [x, y, z, Number::zero(), Number::zero(), Number::zero()],
            (None, None) => [(); 6].map(|()| Number::zero()),
        };
        let has_tensor = tensor.iter().any(|entry| !entry.is_zero());
        if mass.value < 0.0 || (mass.is_zero() && has_tensor) {
            let message = format!("the mass of {} is not positive", item.owner);
            self.faults.add(element.at, message);
        }
        if let Some(flaw) = tensor::flaw(&tensor) {
            let message = format!(
                "the tensor of inertia of {} is impossible for a body: {flaw}",
                item.owner
            );
            self.faults.add(element.at, message);
        }
        let source = if turns.is_empty() || !has_tensor {
            ""
        } else {
            "; the file gives it in rotated axes"
        };
        (!mass.is_zero()).then_some(Inertial {
            mass,
            xyz,
            turns,
            tensor,
            source,
        })
    }

    /// Scales all masses to the total that the compiler settings give.
    pub(super) fn settle_mass(&mut self) {
        let Some(total) = self.compiler.total_mass else {
            return;
        };
        let all = self.robot.links.iter_mut();
        let mut weights: Vec<&mut Inertial> =
            all.filter_map(|link| link.inertial.as_mut()).collect();
        let sum: f64 = weights.iter().map(|inertial| inertial.mass.value).sum();
        let scaled = |number: &Number| Number::computed(number.value * (total / sum));
        for inertial in &mut weights {
            inertial.mass = scaled(&inertial.mass);
            inertial.tensor = inertial.tensor.each_ref().map(scaled);
            inertial.source = if inertial.source.contains("geoms") {
                "; from its geoms, scaled to the total mass of the file"
            } else {
                "; scaled to the total mass of the file"
            };
        }
    }
}

/// The fixed joint from the last joint of a body to the body's frame.
fn to_frame(above: String, link: &Parent, pose: Pose) -> Joint {
    Joint {
        name: format!("{}\nframe", link.name),
        label: "fixed",
        parent: above,
        child: link.name.clone(),
        xyz: pose.xyz,
        turns: pose.turns,
        ..Joint::default()
    }
}

/// Whether there are bodies in a body, or in a frame in it.
fn has_bodies(element: &Element) -> bool {
    let has_one = |part: &Element| match part.name.as_str() {
        "body" => true,
        "frame" => has_bodies(part),
        _ => false,
    };
    element.children.iter().any(has_one)
}
