//! Closed loops of bodies, and the initial state of a model.

use super::*;
use crate::import::robot::Anchor;

/// A pose: axes as columns, and a position.
#[derive(Clone, Copy)]
struct Rest {
    axes: Matrix3<f64>,
    origin: Vector3<f64>,
}

/// Components below this fraction of the lengths in a position are round-off.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The number of positions of all joints in which conditions are compared, besides the reference configuration. A condition that is
/// the same in all of them is constant.
const POSITIONS: usize = 4;

/// The largest variation of a constant condition, and its largest value where it holds, relative to its terms: round-off, and what
/// the digits of a file may leave.
const VARIATION: f64 = 1e-12;
const DIGITS: f64 = 1e-6;

/// A displacement by a joint, by up to 1 m and 1 rad: some values, but the same for the same numbers.
fn displacement(joint: &Joint, index: usize, position: usize) -> Rest {
    let value = |k: usize| {
        let [index, position] = [(7 * index + k) as f64, position as f64];
        (1.0 + 0.754_877_666_246_693 * index + 0.569_840_290_998_053 * position).sin()
    };
    let values = || Vector3::new(value(0), value(1), value(2));
    let turned = |vector: Vector3<f64>| *nalgebra::Rotation3::new(vector).matrix();
    let axis = Vector3::from(joint.axis);
    let [none, unturned] = [Vector3::zeros(), Vector3::zeros()];
    let (origin, turn) = match joint.kind {
        JointKind::Fixed => (none, unturned),
        JointKind::Prismatic => (axis * value(0), unturned),
        JointKind::Revolute | JointKind::Continuous => (none, axis * value(0)),
        JointKind::Spherical => (none, values()),
        JointKind::Floating | JointKind::Planar => {
            (values(), Vector3::new(value(3), value(4), value(5)))
        }
    };
    Rest {
        axes: turned(turn),
        origin,
    }
}

impl<'e> Reader<'_, '_, 'e> {
    /// The pose of a body in the reference configuration of all joints; `None` if there is no body of this name.
    fn reference_pose(&self, body: &str) -> Option<Rest> {
        self.pose_in(0, body)
    }

    /// The pose of a body in one of several positions of all joints; the first is the reference configuration.
    fn pose_in(&self, position: usize, body: &str) -> Option<Rest> {
        let mut rests = HashMap::from([(
            "world",
            Rest {
                axes: Matrix3::identity(),
                origin: Vector3::zeros(),
            },
        )]);
        // Each joint comes after its parent.
        for (index, joint) in self.robot.joints.iter().enumerate() {
            let above = *rests.get(joint.parent.as_str())?;
            let number = |number: &Number| number.value;
            let mut rest = Rest {
                origin: above.origin + above.axes * Vector3::from(joint.xyz.each_ref().map(number)),
                axes: above.axes * steps::axes(&joint.turns),
            };
            if position > 0 {
                let moved = displacement(joint, index, position);
                rest.origin += rest.axes * moved.origin;
                rest.axes *= moved.axes;
            } else if let Some(start) = &joint.start {
                rest.origin += rest.axes * Vector3::from(start.xyz.each_ref().map(number));
                rest.axes *= start.axes;
            }
            rests.insert(&joint.child, rest);
        }
        rests.get(body).copied()
    }

    /// The body that an attribute names, or the world.
    fn body_of(&mut self, item: &Item<'e>, name: &str) -> Option<(String, Rest)> {
        let (body, at) = match self.attribute_of(item, name) {
            Some(attribute) => (attribute.value.clone(), attribute.at),
            None => ("world".to_owned(), item.element.at),
        };
        let rest = self.reference_pose(&body);
        if rest.is_none() {
            let message = format!(
                "`{name}` of {} is {}, but there is no such body",
                item.owner,
                quoted(&body)
            );
            self.faults.add(at, message);
        }
        Some((body, rest?))
    }

    /// A loop closure: a point of one body coincides with one of another, and for `weld` their axes do too, either as in the
    /// reference configuration or as `relpose` gives.
    pub(super) fn closing(&mut self, element: &'e Element) {
        let kind = element.name.as_str();
        let item = self.item_as(element, "equality");
        let is_weld = kind == "weld";
        self.only(
            element,
            &item.owner,
            if is_weld {
                "equality.weld"
            } else {
                "equality.connect"
            },
        );
        if self.flag(&item, "active") == Some(false) {
            return self.count(&format!("inactive `equality` of {kind}"));
        }
        if !self.names_its_bodies(&item, is_weld) {
            return;
        }
        let (Some((first_link, first)), Some((second_link, second))) =
            (self.body_of(&item, "body1"), self.body_of(&item, "body2"))
        else {
            return;
        };
        let (anchors, axes) = self.anchors(&item, is_weld, [&first, &second]);
        let [first, second] = anchors;
        let bodies = [first_link.as_str(), second_link.as_str()];
        let Some(varies) = self.variations(bodies, [&first, &second], axes.as_ref()) else {
            let message = format!(
                "{} cannot be satisfied: no joint moves or turns its bodies to where it holds them",
                item.owner
            );
            return self.faults.add(element.at, message);
        };
        self.robot.ties.push(Tie {
            name: match element.own("name") {
                Some(name) => name.value.clone(),
                None => format!("{kind}_{first_link}_{second_link}"),
            },
            kind: TieKind::Closing {
                anchors: Box::new([
                    Anchor {
                        link: first_link,
                        xyz: first,
                    },
                    Anchor {
                        link: second_link,
                        xyz: second,
                    },
                ]),
                axes,
                varies,
            },
        });
    }

    /// Checks that the closure of a loop is written by its bodies and an anchor, and not by sites.
    fn names_its_bodies(&mut self, item: &Item<'e>, is_weld: bool) -> bool {
        let element = item.element;
        for name in ["site1", "site2"] {
            if let Some(attribute) = self.attribute_of(item, name) {
                let message = format!(
                    "`{name}` of {} is not supported: write `body1`, `body2` and `anchor`",
                    item.owner
                );
                self.refuse(attribute.at, &element.name, &message);
                return false;
            }
        }
        let needed = if is_weld {
            &["body1"][..]
        } else {
            &["body1", "anchor"]
        };
        for name in needed {
            if self.attribute_of(item, name).is_none() {
                let message = format!("{} lacks `{name}`", item.owner);
                self.faults.add(element.at, message);
                return false;
            }
        }
        true
    }

    /// The points of both bodies that coincide, each in the frame of its body, and the axes of the second body in the frame of the first,
    /// if they are held too.
    fn anchors(
        &mut self,
        item: &Item<'e>,
        is_weld: bool,
        [first, second]: [&Rest; 2],
    ) -> ([[Number; 3]; 2], Option<Matrix3<f64>>) {
        let anchor = self.numbers::<3>(item, "anchor").unwrap_or_default();
        let place = Vector3::from(anchor.each_ref().map(|number| number.value));
        let between = Rest {
            axes: first.axes.transpose() * second.axes,
            origin: first.axes.transpose() * (second.origin - first.origin),
        };
        let size = place.amax() + first.origin.amax() + second.origin.amax();
        let numbers = |place: Vector3<f64>| -> [Number; 3] {
            let clean = |x: f64| {
                if x.abs() <= ROUNDING * size {
                    Number::zero()
                } else {
                    Number::computed(x)
                }
            };
            place.map(clean).into()
        };
        if is_weld {
            let mut axes = between.axes;
            let mut there = between.origin + between.axes * place;
            if let Some(pose) = self.numbers::<7>(item, "relpose") {
                let [x, y, z, turn @ ..] = pose.map(|number| number.value);
                // The position of `relpose` is that of the anchor.
                if turn.iter().any(|x| *x != 0.0) {
                    axes = of_quaternion(turn);
                    there = Vector3::new(x, y, z);
                }
            }
            ([numbers(there), anchor], Some(axes))
        } else {
            let there = between.axes.transpose() * (place - between.origin);
            ([anchor, numbers(there)], None)
        }
    }

    /// Which of the conditions of a loop depend on the values of joints; `None` if one that does not is never satisfied.
    fn variations(
        &self,
        bodies: [&str; 2],
        anchors: [&[Number; 3]; 2],
        axes: Option<&Matrix3<f64>>,
    ) -> Option<[bool; 6]> {
        let anchors = anchors.map(|anchor| Vector3::from(anchor.each_ref().map(|x| x.value)));
        let mut size = 0.0_f64;
        let mut found: Vec<([f64; 6], f64)> = Vec::new();
        for position in 0..=POSITIONS {
            let one = self.pose_in(position, bodies[0])?;
            let other = self.pose_in(position, bodies[1])?;
            let places = [(one, anchors[0]), (other, anchors[1])];
            let [first, second] = places.map(|(body, anchor)| body.origin + body.axes * anchor);
            size = size.max(first.amax()).max(second.amax());
            let held = axes.map(|axes| one.axes * axes);
            let cosine = |a: usize, b: usize| {
                held.map_or(0.0, |held| held.column(a).dot(&other.axes.column(b)))
            };
            let [x, y, z]: [f64; 3] = (first - second).into();
            // As they are written: the axis after each stays at a right angle to the one before it.
            let values = [x, y, z, cosine(1, 2), cosine(2, 0), cosine(0, 1)];
            found.push((values, cosine(0, 0) + cosine(1, 1) + cosine(2, 2)));
        }
        let (reference, alike) = *found.first()?;
        let scale = |k: usize| if k < 3 { size } else { 1.0 };
        let varies: [bool; 6] = std::array::from_fn(|k| {
            let is_other = |(values, _): &([f64; 6], f64)| {
                (values[k] - reference[k]).abs() > VARIATION * scale(k)
            };
            found.iter().any(is_other)
        });
        let holds = |k: usize| varies[k] || reference[k].abs() <= DIGITS * scale(k);
        // Right angles that never change may be those of an axis that is reversed.
        let is_turned = axes.is_some() && !varies[3..].contains(&true) && alike <= 1.0;
        ((0..6).all(holds) && !is_turned).then_some(varies)
    }

    /// Reads the keyframe `home`, in which the machine starts.
    pub(super) fn read_home_keyframe(&mut self, key: &'e Element) {
        let item = self.item(key, 0);
        if let Some((q, at)) = self.list(&item, "qpos") {
            self.home_places(&item, &q, at);
        }
        if let Some((v, at)) = self.list(&item, "qvel") {
            self.home_rates(&item, &v, at);
        }
        if let Some((u, at)) = self.list(&item, "ctrl") {
            if u.len() != self.actuators {
                return self.report_count(&item, "ctrl", [self.actuators, u.len()], at);
            }
            for drive in &mut self.robot.drives {
                drive.usual = u.get(drive.number).cloned().unwrap_or_default();
            }
        }
    }

    fn report_count(
        &mut self,
        item: &Item<'e>,
        name: &str,
        [wanted, found]: [usize; 2],
        at: usize,
    ) {
        let message = format!(
            "`{name}` of {}: {wanted} numbers are expected, but there are {found}",
            item.owner
        );
        self.faults.add(at, message);
    }

    fn home_places(&mut self, item: &Item<'e>, q: &[Number], at: usize) {
        let length = |kind: JointKind| match kind {
            JointKind::Fixed => 0,
            JointKind::Floating => 7,
            JointKind::Spherical => 4,
            _ => 1,
        };
        let wanted = self.robot.joints.iter().map(|joint| length(joint.kind));
        let wanted = wanted.sum();
        if q.len() != wanted {
            return self.report_count(item, "qpos", [wanted, q.len()], at);
        }
        let mut rest = q;
        for joint in &mut self.robot.joints {
            let (values, after) = rest.split_at(length(joint.kind));
            rest = after;
            let (place, turn) = match values {
                [] => continue,
                [value] => {
                    joint.home = Some(value.clone());
                    continue;
                }
                [x, y, z, turn @ ..] if joint.kind == JointKind::Floating => {
                    ([x, y, z].map(Clone::clone), turn)
                }
                turn => (<[Number; 3]>::default(), turn),
            };
            let turn: Vec<f64> = turn.iter().map(|number| number.value).collect();
            let Ok(turn) = <[f64; 4]>::try_from(turn) else {
                continue;
            };
            joint.start = Some(Start {
                xyz: place,
                axes: of_quaternion(turn),
            });
        }
    }

    fn home_rates(&mut self, item: &Item<'e>, v: &[Number], at: usize) {
        let length = |kind: JointKind| match kind {
            JointKind::Fixed => 0,
            JointKind::Floating => 6,
            JointKind::Spherical => 3,
            _ => 1,
        };
        let wanted = self.robot.joints.iter().map(|joint| length(joint.kind));
        let wanted = wanted.sum();
        if v.len() != wanted {
            return self.report_count(item, "qvel", [wanted, v.len()], at);
        }
        let mut rest = v;
        let mut is_turning = false;
        for joint in &mut self.robot.joints {
            let (values, after) = rest.split_at(length(joint.kind));
            rest = after;
            match values {
                [value] => joint.home_rate = Some(value.clone()),
                several => is_turning |= several.iter().any(|number| !number.is_zero()),
            }
        }
        if is_turning {
            let message = format!(
                "`qvel` of {} moves a free or a ball joint, whose rates are not supported",
                item.owner
            );
            self.refuse(at, "qvel", &message);
        }
    }
}

/// The rotation matrix of a quaternion; the identity if it is zero.
fn of_quaternion([w, x, y, z]: [f64; 4]) -> Matrix3<f64> {
    let square = w * w + x * x + y * y + z * z;
    if square == 0.0 {
        return Matrix3::identity();
    }
    let s = 2.0 / square;
    Matrix3::new(
        1.0 - s * (y * y + z * z),
        s * (x * y - w * z),
        s * (x * z + w * y),
        s * (x * y + w * z),
        1.0 - s * (x * x + z * z),
        s * (y * z - w * x),
        s * (x * z - w * y),
        s * (y * z + w * x),
        1.0 - s * (x * x + y * y),
    )
}
