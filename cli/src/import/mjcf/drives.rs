//! Forces on joints besides their own springs and dampers: actuators, equations between joints, tendons.

use super::*;

impl<'e> Reader<'_, '_, 'e> {
    /// The joint that an attribute names.
    fn named(&mut self, item: &Item<'e>, name: &str) -> Option<usize> {
        let attribute = self.attribute_of(item, name)?;
        let found = self.joints.get(&attribute.value).copied();
        if found.is_none() {
            let message = format!(
                "`{name}` of {} is {}, but there is no such joint",
                item.owner,
                quoted(&attribute.value)
            );
            self.faults.add(attribute.at, message);
        }
        let joint = found.map(|found| &self.robot.joints[found]);
        if let Some(joint) = joint.filter(|joint| !joint.kind.is_single()) {
            let message = format!(
                "`{name}` of {} is {}, a {} joint: a joint with a single coordinate is expected",
                item.owner,
                quoted(&attribute.value),
                joint.label
            );
            self.refuse(attribute.at, &item.element.name, &message);
            return None;
        }
        found
    }

    /// Reads a tendon; without spring, damper and friction it has no effect by itself.
    pub(super) fn tendon(&mut self, element: &'e Element) {
        let item = self.item_as(element, "tendon");
        let acts = [
            "stiffness",
            "damping",
            "frictionloss",
            "armature",
            "springlength",
        ];
        for name in acts {
            if let Some(attribute) = self.attribute_of(&item, name)
                && attribute
                    .value
                    .split_whitespace()
                    .any(|number| number.parse() != Ok(0.0))
                && (name != "springlength" || self.attribute_of(&item, "stiffness").is_some())
            {
                let message = format!("`{name}` of the tendon {} is not supported", item.owner);
                return self.refuse(element.at, "tendon", &message);
            }
        }
        if self.is_limited(&item, "limited", "range") {
            let message = format!("the range of the tendon {} is not supported", item.owner);
            self.refuse(element.at, "tendon", &message);
        }
    }

    pub(super) fn actuator(&mut self, element: &'e Element) {
        let kind = element.name.as_str();
        if !DRIVES.contains(&kind) {
            return self.unknown(element, "the actuators");
        }
        let number = self.actuators;
        self.actuators += 1;
        if self.ignored.iter().any(|ignored| ignored == kind) {
            return self.count(kind);
        }
        let item = self.item(element, 0);
        self.only(element, &item.owner, kind);
        let place = match self.attribute_of(&item, "joint") {
            Some(_) => "joint",
            None => "jointinparent",
        };
        if self.attribute_of(&item, place).is_none() {
            let message = format!("{} moves no joint, which is not supported", item.owner);
            return self.refuse(element.at, kind, &message);
        }
        let Some(joint) = self.named(&item, place) else {
            return;
        };
        let gear = match self.list(&item, "gear") {
            Some((numbers, _)) => numbers.into_iter().next().unwrap_or_default(),
            None => Number::computed(1.0),
        };
        if gear.is_zero() {
            let message = format!("the gear of {} is 0", item.owner);
            self.faults.add(element.at, message);
        }
        let Some(law) = self.law(&item, kind) else {
            return;
        };
        for (flag, range, what) in [
            ("ctrllimited", "ctrlrange", "`ctrlrange` of actuator"),
            ("forcelimited", "forcerange", "`forcerange` of actuator"),
        ] {
            if self.is_limited(&item, flag, range) {
                self.count(what);
            }
        }
        let name = element.own("name").map(|name| name.value.clone());
        self.robot.drives.push(Drive {
            name: name.unwrap_or_default(),
            joint,
            gear,
            law,
            inertia: Number::zero(),
            number,
            usual: Number::zero(),
        });
    }

    /// MuJoCo has a single default for actuators of all kinds, which each kind modifies in turn. If classes set attributes of
    /// several kinds, an actuator must give the attributes of its force itself.
    fn sets_own_force(&mut self, item: &Item<'e>, kind: &str, needed: &[&str]) -> bool {
        let tags = self.classes.tags(item.class, &DRIVES);
        let is_clear =
            tags.iter().all(|tag| *tag == kind) || tags.iter().all(|tag| *tag == "motor");
        let mut missing = needed
            .iter()
            .filter(|name| item.element.own(name).is_none());
        match missing.next() {
            Some(name) if !is_clear => {
                let message = format!(
                    "the classes set attributes of actuators of several kinds, {}: specify `{name}` of {} itself",
                    tags.join(" and "),
                    item.owner
                );
                self.faults.add(item.element.at, message);
                false
            }
            _ => true,
        }
    }

    /// The force of an actuator as a function of its input.
    fn law(&mut self, item: &Item<'e>, kind: &str) -> Option<Law> {
        let number = |reader: &mut Self, name: &str, usual: f64| {
            reader
                .number(item, name)
                .unwrap_or_else(|| Number::computed(usual))
        };
        let needed: &[&str] = match kind {
            "motor" => &[],
            "velocity" => &["kv"],
            "position" => &["kp", "kv"],
            _ => &["gainprm", "biastype", "biasprm"],
        };
        if !self.sets_own_force(item, kind, needed) {
            return None;
        }
        match kind {
            "motor" => Some(Law::Force),
            "velocity" => Some(Law::Rate {
                damping: number(self, "kv", 1.0),
            }),
            "position" => {
                if let Some(attribute) = self.attribute_of(item, "dampratio")
                    && attribute.value.parse() != Ok(0.0)
                {
                    let message =
                        format!("`dampratio` of {} is not supported: write `kv`", item.owner);
                    self.refuse(attribute.at, "dampratio", &message);
                }
                Some(Law::Position {
                    stiffness: number(self, "kp", 1.0),
                    damping: number(self, "kv", 0.0),
                })
            }
            _ => self.general(item),
        }
    }

    /// A general actuator with constant gain and affine bias.
    fn general(&mut self, item: &Item<'e>) -> Option<Law> {
        for (name, fine) in [
            ("dyntype", &["none"][..]),
            ("gaintype", &["fixed"]),
            ("biastype", &["none", "affine"]),
        ] {
            if let Some(attribute) = self.attribute_of(item, name)
                && !fine.contains(&attribute.value.as_str())
            {
                let message = format!(
                    "`{name}` of {} is {}, which is not supported",
                    item.owner,
                    quoted(&attribute.value)
                );
                self.refuse(attribute.at, "general", &message);
                return None;
            }
        }
        let first =
            |reader: &mut Self, name: &str| reader.list(item, name).map(|(numbers, _)| numbers);
        let gain = first(self, "gainprm").and_then(|list| list.into_iter().next());
        let gain = gain.unwrap_or_else(|| Number::computed(1.0));
        let mut bias = [(); 3].map(|()| Number::zero());
        if self.word(item, "biastype") == Some("affine") {
            let list = first(self, "biasprm").unwrap_or_default();
            for (place, number) in bias.iter_mut().zip(list) {
                *place = number;
            }
        }
        let [constant, of_length, of_rate] = bias;
        let is_zero = |numbers: &[&Number]| numbers.iter().all(|number| number.is_zero());
        if gain.value == 1.0 && is_zero(&[&constant, &of_length, &of_rate]) {
            return Some(Law::Force);
        }
        if gain.value == -of_length.value && constant.is_zero() {
            return Some(Law::Position {
                stiffness: gain,
                damping: of_rate.negated(),
            });
        }
        if gain.value == -of_rate.value && is_zero(&[&constant, &of_length]) {
            return Some(Law::Rate { damping: gain });
        }
        Some(Law::Affine {
            gain,
            constant,
            of_length,
            of_rate,
        })
    }

    pub(super) fn equality(&mut self, element: &'e Element) {
        let kind = element.name.as_str();
        if self.ignored.iter().any(|ignored| ignored == kind) {
            return self.count(kind);
        }
        if matches!(kind, "connect" | "weld") {
            return self.closing(element);
        }
        if kind != "joint" {
            return self.unknown(element, "the equality constraints");
        }
        let item = self.item_as(element, "equality");
        self.only(element, &item.owner, "equality.joint");
        if self.flag(&item, "active") == Some(false) {
            return self.count("inactive `equality` of joint");
        }
        if self.attribute_of(&item, "joint1").is_none() {
            let message = format!(
                "{} does not specify which joint: write `joint1`",
                item.owner
            );
            return self.faults.add(element.at, message);
        }
        let Some(follower) = self.named(&item, "joint1") else {
            return;
        };
        let leader = match self.attribute_of(&item, "joint2") {
            None => None,
            Some(_) => match self.named(&item, "joint2") {
                None => return,
                leader => leader,
            },
        };
        // Coefficients that are not given are those of the identity.
        let mut coefficients = match self.list(&item, "polycoef") {
            Some((numbers, _)) => numbers,
            None => vec![Number::zero()],
        };
        if coefficients.len() == 1 {
            coefficients.push(Number::computed(1.0));
        }
        let most = if leader.is_some() { 5 } else { 1 };
        self.robot.ties.push(Tie {
            name: match element.own("name") {
                Some(name) => name.value.clone(),
                None => format!("{}_follows", self.robot.joints[follower].name),
            },
            kind: TieKind::Polynomial {
                follower,
                leader,
                coefficients: coefficients.into_iter().take(most).collect(),
            },
        });
    }
}
