//! What acts along joints: friction, damping, springs, stops and drives; and what ties joints to each other.

use nalgebra::Matrix3;

use super::Writer;
use super::coordinates::{measured, unit_of};
use crate::call::{Friction, Limits};
use crate::diagnostics::counted;
use crate::import::faults::Faults;
use crate::import::names::{Names, quoted};
use crate::import::number::Number;
use crate::import::robot::{Anchor, Drive, Joint, JointKind, Law, TieKind};
use crate::import::steps::AXES;

/// The units of what acts along a joint.
struct Units {
    force: &'static str,
    travel: &'static str,
    rate: &'static str,
    stiffness: &'static str,
    damping: &'static str,
    mass: &'static str,
}

/// Along a joint that turns.
const TURNING: Units = Units {
    force: "N*m",
    travel: "rad",
    rate: "rad/s",
    stiffness: "N*m",
    damping: "N*m*s",
    mass: "kg*m^2",
};

/// Along a joint that slides.
const SLIDING: Units = Units {
    force: "N",
    travel: "m",
    rate: "m/s",
    stiffness: "N/m",
    damping: "N*s/m",
    mass: "kg",
};

/// A joint with one coordinate, and the parameters of what acts along it.
struct Along<'r> {
    joint: &'r Joint,
    /// The formula of its angle or its travel.
    value: String,
    units: &'static Units,
    entries: Vec<String>,
}

/// A joint that is driven, and the parameters of its drive.
struct Driven {
    /// The formula of its angle or its travel.
    value: String,
    units: &'static Units,
    /// The name of the input.
    input: String,
    /// The gear ratio as a factor, `ratio*`, or nothing.
    gear: String,
    entries: Vec<String>,
}

/// The name of the input of a drive: its own, or that of its joint with what the input is.
fn input_name(joint: &Joint, drive: &Drive) -> String {
    if !drive.name.is_empty() && drive.name != joint.name {
        return drive.name.clone();
    }
    let suffix = match (&drive.law, joint.kind) {
        (Law::Force, JointKind::Prismatic) => "force",
        (Law::Force, _) => "torque",
        (Law::Affine { .. }, _) => "control",
        (Law::Position { .. }, _) => "target",
        (Law::Rate { .. }, _) => "target_rate",
    };
    format!("{}_{suffix}", joint.name)
}

/// The rates below which smooth friction falls, of joints that turn and of those that slide, once they are parameters.
#[derive(Default)]
struct Smoothing {
    turning: Option<String>,
    sliding: Option<String>,
}

impl Units {
    fn of(joint: &Joint) -> &'static Units {
        match joint.kind {
            JointKind::Prismatic => &SLIDING,
            _ => &TURNING,
        }
    }
}

impl Writer<'_> {
    /// Adds dampers, friction and stops.
    pub(super) fn along_joints(&mut self, faults: &mut Faults) {
        let mut left_out = Vec::new();
        let mut limited = 0;
        let mut restitution = None;
        let mut smoothing = Smoothing::default();
        for (index, joint) in self.joints().filter(|(_, joint)| joint.kind.is_single()) {
            let mut along = Along {
                joint,
                value: self.value_of[index].clone(),
                units: Units::of(joint),
                entries: Vec::new(),
            };
            self.spring(&mut along);
            self.rotor(&mut along);
            self.damper(&mut along);
            match self.call.friction {
                Some(Friction::Smooth(rate)) => {
                    self.smooth_friction(&mut along, rate, &mut smoothing);
                }
                Some(Friction::None) if !joint.friction.is_zero() => {
                    left_out.push(quoted(&joint.name));
                }
                _ => {}
            }
            if let Some([lower, upper]) = &joint.range {
                limited += 1;
                if self.call.limits != Limits::None {
                    let range = [lower, upper];
                    self.range(&mut along, range, &mut restitution, faults);
                }
            }
            let comment = format!("Joint {}: the forces along it.", quoted(&joint.name));
            self.text.add("parameters", Some(comment), along.entries);
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

    /// A parameter of what acts along a joint, with the name of the joint and a suffix.
    fn parameter_along(
        &mut self,
        along: &mut Along<'_>,
        suffix: &str,
        unit: &str,
        text: &str,
    ) -> String {
        let name = format!("{}_{suffix}", along.value);
        self.parameter(&mut along.entries, &name, unit, text)
    }

    fn spring(&mut self, along: &mut Along<'_>) {
        let joint = along.joint;
        if joint.stiffness.is_zero() {
            return;
        }
        let text = joint.stiffness.to_string();
        let stiffness = self.parameter_along(along, "stiffness", along.units.stiffness, &text);
        let value = along.value.clone();
        let stretch = if joint.free_at.is_zero() {
            value.clone()
        } else {
            let text = measured(joint, &joint.free_at);
            let free = self.parameter_along(along, "free_at", unit_of(joint), &text);
            format!("{value} - {free}")
        };
        let spring = format!("{value} {{ stiffness: {stiffness}, stretch: {stretch} }}");
        self.text.add("springs", None, vec![spring]);
    }

    fn rotor(&mut self, along: &mut Along<'_>) {
        if along.joint.armature.is_zero() {
            return;
        }
        let text = along.joint.armature.to_string();
        let inertia = self.parameter_along(along, "armature", along.units.mass, &text);
        let value = &along.value;
        let rotor = format!("{value} {{ inertia: {inertia}, angle: {value} }}");
        self.text.add("rotors", None, vec![rotor]);
    }

    fn damper(&mut self, along: &mut Along<'_>) {
        if along.joint.damping.is_zero() {
            return;
        }
        let text = along.joint.damping.to_string();
        let damping = self.parameter_along(along, "damping", along.units.damping, &text);
        let value = &along.value;
        let damper = format!("{value} {{ damping: {damping}, stretch: {value} }}");
        self.text.add("dampers", None, vec![damper]);
    }

    /// Adds friction that falls to zero below a rate.
    fn smooth_friction(&mut self, along: &mut Along<'_>, rate: f64, smoothing: &mut Smoothing) {
        if along.joint.friction.is_zero() {
            return;
        }
        let text = along.joint.friction.to_string();
        let friction = self.parameter_along(along, "friction", along.units.force, &text);
        let (known, name) = match along.joint.kind {
            JointKind::Prismatic => (&mut smoothing.sliding, "smoothing_of_slides"),
            _ => (&mut smoothing.turning, "smoothing"),
        };
        let rate = known.get_or_insert_with(|| {
            let mut entry = Vec::new();
            let rate = Number::computed(rate).to_string();
            let parameter = self.parameter(&mut entry, name, along.units.rate, &rate);
            let comment = "Below this rate friction falls to zero instead of sticking.";
            self.text.add("parameters", Some(comment.to_owned()), entry);
            parameter
        });
        let value = &along.value;
        let formula = format!("{value}: {friction}*sqrt(der({value})^2 + {rate}^2)");
        self.text.add("dissipations", None, vec![formula]);
    }

    /// Handles the limits of a joint.
    fn range(
        &mut self,
        along: &mut Along<'_>,
        range: [&Number; 2],
        restitution: &mut Option<String>,
        faults: &mut Faults,
    ) {
        let joint = along.joint;
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
            self.parameter_along(along, end, unit, &text)
        });
        let value = &along.value;
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
    pub(super) fn drives(&mut self) {
        for drive in &self.robot.drives {
            self.drive(drive);
        }
    }

    pub(super) fn drive(&mut self, drive: &Drive) {
        let joint = &self.robot.joints[drive.joint];
        if self.is_dropped[drive.joint] {
            let name = quoted(&drive.name);
            return self
                .warnings
                .push(format!("drive {name} is left out with its joint"));
        }
        let name = input_name(joint, drive);
        let input = self.values.take(&name, "input");
        let mut driven = Driven {
            value: self.value_of[drive.joint].clone(),
            units: Units::of(joint),
            input: input.clone(),
            gear: String::new(),
            entries: Vec::new(),
        };
        if drive.gear.value != 1.0 {
            let gear = self.parameter_of(&mut driven, "gear", "1", &drive.gear);
            driven.gear = format!("{gear}*");
        }
        let (unit, law) = self.law(&mut driven, &drive.law);
        let (coordinate, factor) = self.coordinate_of[drive.joint].clone();
        let on = self.value_of[coordinate].clone();
        let law = if factor.is_empty() || law.starts_with('(') {
            law
        } else {
            format!("({law})")
        };
        let force = format!(
            "{input} {{ on: {on}, value: {factor}{}{law} }}",
            driven.gear
        );
        if !drive.inertia.is_zero() {
            let mass = driven.units.mass;
            let inertia = self.parameter_of(&mut driven, "inertia", mass, &drive.inertia);
            let angle = format!("{}{}", driven.gear, driven.value);
            let rotor = format!("{input} {{ inertia: {inertia}, angle: {angle} }}");
            self.text.add("rotors", None, vec![rotor]);
        }
        self.text.add("forces", None, vec![force]);
        let shown = if drive.name.is_empty() {
            String::new()
        } else {
            format!(" {}", quoted(&drive.name))
        };
        let comment = format!("Drive{shown} of joint {}.", quoted(&joint.name));
        let entries = driven.entries;
        self.text.add("parameters", Some(comment.clone()), entries);
        let usual = if drive.usual.is_zero() {
            String::new()
        } else {
            format!(" = {}", drive.usual)
        };
        let entry = format!("{input}: {unit}{usual}");
        self.text.add("inputs", Some(comment), vec![entry]);
    }

    /// A parameter of a drive, with the name of its input and a suffix.
    fn parameter_of(
        &mut self,
        driven: &mut Driven,
        suffix: &str,
        unit: &str,
        number: &Number,
    ) -> String {
        let name = format!("{}_{suffix}", driven.input);
        self.parameter(&mut driven.entries, &name, unit, &number.to_string())
    }

    /// The unit of the input of a drive, and the formula of its force before the gear.
    fn law(&mut self, driven: &mut Driven, law: &Law) -> (&'static str, String) {
        let units = driven.units;
        let (input, value, gear) = (
            driven.input.clone(),
            driven.value.clone(),
            driven.gear.clone(),
        );
        match law {
            Law::Force => (units.force, input),
            Law::Position { stiffness, damping } => {
                let k = self.parameter_of(driven, "stiffness", units.stiffness, stiffness);
                let mut law = format!("{k}*({input} - {gear}{value})");
                if !damping.is_zero() {
                    let b = self.parameter_of(driven, "damping", units.damping, damping);
                    law.push_str(&format!(" - {b}*{gear}der({value})"));
                }
                if !gear.is_empty() && !damping.is_zero() {
                    law = format!("({law})");
                }
                (units.travel, law)
            }
            Law::Rate { damping } => {
                let b = self.parameter_of(driven, "damping", units.damping, damping);
                (units.rate, format!("{b}*({input} - {gear}der({value}))"))
            }
            Law::Affine {
                gain,
                constant,
                of_length,
                of_rate,
            } => {
                let gain = self.parameter_of(driven, "gain", units.force, gain);
                let mut law = format!("{gain}*{input}");
                let (length, rate) = (format!("*{gear}{value}"), format!("*{gear}der({value})"));
                let terms = [
                    (constant, "constant", units.force, String::new()),
                    (of_length, "of_length", units.stiffness, length),
                    (of_rate, "of_rate", units.damping, rate),
                ];
                for (number, suffix, unit, times) in terms {
                    if !number.is_zero() {
                        let factor = self.parameter_of(driven, suffix, unit, number);
                        law.push_str(&format!(" + {factor}{times}"));
                    }
                }
                ("1", format!("({law})"))
            }
        }
    }

    /// Adds equations between coordinates.
    pub(super) fn ties(&mut self) {
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
    pub(super) fn closing(
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
    pub(super) fn meeting(
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
}
