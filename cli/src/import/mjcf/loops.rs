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

impl<'e> Reader<'_, '_, 'e> {
    /// The pose of a body in the reference configuration of all joints; `None` if there is no body of this name.
    fn reference_pose(&self, body: &str) -> Option<Rest> {
        let mut rests = HashMap::from([(
            "world",
            Rest {
                axes: Matrix3::identity(),
                origin: Vector3::zeros(),
            },
        )]);
        // Each joint comes after its parent.
        for joint in &self.robot.joints {
            let above = *rests.get(joint.parent.as_str())?;
            let number = |number: &Number| number.value;
            let mut rest = Rest {
                origin: above.origin + above.axes * Vector3::from(joint.xyz.each_ref().map(number)),
                axes: above.axes * steps::axes(&joint.turns),
            };
            if let Some(start) = &joint.start {
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
        for name in ["site1", "site2"] {
            if let Some(attribute) = self.attribute_of(&item, name) {
                let message = format!(
                    "`{name}` of {} is not supported: write `body1`, `body2` and `anchor`",
                    item.owner
                );
                return self.refuse(attribute.at, kind, &message);
            }
        }
        let needed = if is_weld {
            &["body1"][..]
        } else {
            &["body1", "anchor"]
        };
        for name in needed {
            if self.attribute_of(&item, name).is_none() {
                let message = format!("{} lacks `{name}`", item.owner);
                return self.faults.add(element.at, message);
            }
        }
        let (Some((first_link, first)), Some((second_link, second))) =
            (self.body_of(&item, "body1"), self.body_of(&item, "body2"))
        else {
            return;
        };
        let anchor = self.numbers::<3>(&item, "anchor").unwrap_or_default();
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
        let (anchors, axes) = if is_weld {
            let mut axes = between.axes;
            let mut there = between.origin + between.axes * place;
            if let Some(pose) = self.numbers::<7>(&item, "relpose") {
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
        };
        let [first, second] = anchors;
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
            },
        });
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
        let length = |kind: Kind| match kind {
            Kind::Fixed => 0,
            Kind::Floating => 7,
            Kind::Spherical => 4,
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
                [x, y, z, turn @ ..] if joint.kind == Kind::Floating => {
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
        let length = |kind: Kind| match kind {
            Kind::Fixed => 0,
            Kind::Floating => 6,
            Kind::Spherical => 3,
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
